// SPDX-License-Identifier: Apache-2.0
/// The seam between the particle filter and whoever compares its observation with the map.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/affine.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/view/observation.hpp"
#include "semview/view/view_source.hpp"

namespace semview {

enum class HeadingMode {
  kAsGiven,  ///< each pose at its own heading
  kCompass,  ///< visual compass: all 120 headings of the grid, the best is reported
};

struct ScoreRequest {
  std::vector<Pose2> poses;
  HeadingMode mode = HeadingMode::kAsGiven;
  bool whole_curve = false;  ///< compass only: also the sum of each heading
  /// How the map is distorted if the pose is right: one a pose, or empty for a map as it is. A
  /// pose's position is in the drawn map, its yaw in the true world. Taken on the grid of
  /// `kAffineStep`.
  std::vector<MapAffine> affines = {};
};

/// The sum of a pose that has no view (docs/conventions.md#view-of-a-cell).
inline constexpr std::int32_t kNoView = std::numeric_limits<std::int32_t>::min();

/// Integer sums, so that every deployment computes the same bits:
/// similarity = sum / (weight_scale · observed_pixels), equation (1) of Neubert et al. 2017.
struct ScoreBatch {
  std::int32_t weight_scale = 1;           ///< integer weights = round(weight · weight_scale)
  std::int32_t observed_pixels = 0;        ///< pixels of the observation that are not `kUnknown`
  std::vector<std::int32_t> sums;          ///< one a pose, or `kNoView`
  std::vector<std::uint8_t> best_heading;  ///< compass: one a pose; ties: the lowest index
  std::vector<std::int32_t> curve;         ///< whole_curve: 120 a pose, in order of the headings
  ViewOrigins origins;                     ///< distinct cells, by where their views came from

  double similarity(std::int32_t sum) const {
    return static_cast<double>(sum) /
           (static_cast<double>(weight_scale) * static_cast<double>(observed_pixels));
  }
};

/// Scores poses against the current observation. In-process, cached or remote: same numbers.
///
/// A source is given its weight matrix when it is made.
/// @threads For one thread at a time.
class ScoreSource {
 public:
  virtual ~ScoreSource() = default;
  virtual const ViewProfile& profile() const = 0;

  /// Makes `observation` (in the shape of `profile()`) the one that `score` compares with.
  /// @errors kInvalidArgument: wrong shape, or nothing observed; kFailedPrecondition: a class of
  /// the observation or the map is missing in the weight matrix; kUnavailable, kDeadlineExceeded:
  /// remote.
  virtual Status set_observation(const Observation& observation) = 0;

  /// @errors kFailedPrecondition: no observation set; kInvalidArgument: a pose is not finite.
  virtual Result<ScoreBatch> score(const ScoreRequest& request) = 0;
};

}  // namespace semview
