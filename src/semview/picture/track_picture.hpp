// SPDX-License-Identifier: Apache-2.0
/// Tracks and particles over the plan, with legend and scale bar, as SVG or pixels.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/picture/plan.hpp"

namespace semview::picture {

struct Track {
  std::string name;  ///< in the legend
  Rgb colour;
  bool dashed = false;
  std::vector<Pose2> poses;  ///< frame `map`; a ring marks the first, an arrow the last
};

// Colours that are told apart by people who do not see red or green (Okabe, Ito 2008).
inline constexpr Rgb kTruthColour{0, 0, 0};
inline constexpr Rgb kOdometryColour{213, 94, 0};
inline constexpr Rgb kEstimateColour{0, 114, 178};
inline constexpr Rgb kParticleColour{0, 158, 115};

struct TrackPicture {
  std::optional<Plan> plan = {};
  std::vector<Track> tracks = {};  ///< later ones lie above
  std::vector<Pose2> particles = {};
  std::string title = {};
  int width_px = 1200;
};

RgbImage draw_tracks(const TrackPicture& picture);

/// The same drawing as lines and text; the plan is embedded as pixels.
/// @errors kUnavailable: the file cannot be written.
Status write_tracks_svg(const std::filesystem::path& path, const TrackPicture& picture);

}  // namespace semview::picture
