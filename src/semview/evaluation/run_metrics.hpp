// SPDX-License-Identifier: Apache-2.0
/// How far a trajectory is from the truth.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/io/trajectory.hpp"

namespace semview::evaluation {

/// Errors over the stamps of a trajectory, all >= 0.
struct ErrorSummary {
  double mean = 0.0;
  double median = 0.0;  ///< of an even number of stamps: the mean of the middle two
  double max = 0.0;
  double final = 0.0;  ///< at the last stamp
};

struct TrackErrors {
  std::size_t stamps = 0;   ///< compared
  std::size_t skipped = 0;  ///< before the first or after the last pose of the ground truth
  ErrorSummary position_m;
  ErrorSummary heading_rad;
  /// Seconds from the first compared stamp to the first one from which the position error stays
  /// below the limit to the end; none if the last error is not below it.
  std::optional<double> converged_after_s;
};

/// Half a metre: the robot knows which part of which room it is in.
inline constexpr double kConvergedWithin_m = 0.5;

/// Compares poses (map_from_base) with the ground truth at their own stamps, between whose samples
/// it is interpolated. Nothing is aligned: both are in frame `map`.
/// @errors kOutOfRange: no stamp lies within the ground truth.
Result<TrackErrors> compare(std::span<const io::StampedPose2> poses,
                            std::span<const io::StampedPose2> groundtruth,
                            double converged_within_m = kConvergedWithin_m);

/// Odometry as map_from_base: moved so that it meets the ground truth at the first stamp that both
/// cover; from there on it is dead reckoning.
/// @errors kOutOfRange: they have no time in common.
Result<std::vector<io::StampedPose2>> align_odometry(std::span<const io::StampedPose2> odometry,
                                                     std::span<const io::StampedPose2> groundtruth);

/// `poses` at the stamps of `at`, interpolated; stamps that `poses` does not cover are left out.
/// For comparing two trajectories at the same moments.
std::vector<io::StampedPose2> sample(std::span<const io::StampedPose2> poses,
                                     std::span<const io::StampedPose2> at);

}  // namespace semview::evaluation
