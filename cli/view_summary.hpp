// SPDX-License-Identifier: Apache-2.0
/// What `semview view` says of a view: the engine, the pose, the share of each class.
#pragma once

#include <optional>

#include <nlohmann/json_fwd.hpp>

#include "semview/geometry/image.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/service/site.hpp"

namespace semview::cli {

/// A cast view of either camera.
struct View {
  LabelImage labels;
  RangeImage distances_m;
  std::optional<PanoramaCamera> panorama;  ///< none: a pinhole view, distances are depths
  service::EngineChoice engine;
  double cast_ms = 0.0;
};

/// As `--json` prints it. `warning` is there if the eye does not see the map as a robot would.
nlohmann::ordered_json view_summary(const service::Site& site,
                                    const Pose2& pose,
                                    double eye_z_m,
                                    const View& view);

/// The same on standard output, for people.
void print_view_summary(const nlohmann::ordered_json& summary);

}  // namespace semview::cli
