// SPDX-License-Identifier: Apache-2.0
/// Wheel odometry that drifts.
#pragma once

#include <span>
#include <vector>

#include "semview/core/random.hpp"
#include "semview/io/trajectory.hpp"

namespace semview::simulation {

/// Errors of one drive: constant ones, drawn once (a wheel's wear), and a random walk. The sizes
/// say how the kinds of error compare; `drift_share` says how far off they lead.
struct OdometryNoiseConfig {
  double distance_error = 0.02;   ///< relative, constant in a drive
  double turn_error = 0.02;       ///< relative, constant in a drive
  double veer_rad_per_m = 0.015;  ///< turning that is not noticed (0.86°), constant in a drive
  double distance_walk_m = 0.01;  ///< σ of the random part after 1 m of way
  double turn_walk_rad = 0.01;    ///< σ of the random part after 1 m of way or 1 rad of turning
  /// Position error at the end as a share of the way: all sizes are scaled alike, by 1/4 to 4,
  /// so that the error is 2/3 to 4/3 of that or, on ways that return and let errors cancel, as near
  /// to it as such a scale comes. 0: sizes as they are.
  double drift_share = 0.05;
};

/// What odometry makes of a drive, starting at the pose (0, 0, 0) of its own frame, with the stamps
/// of `truth`. The constant errors are between 0.7 and 1.3 times those of `config`, of either sign.
/// `level` scales sizes and drift: 0 gives the truth as seen from its own start.
std::vector<io::StampedPose2> simulate_odometry(std::span<const io::StampedPose2> truth,
                                                const OdometryNoiseConfig& config,
                                                double level,
                                                Rng& rng);

}  // namespace semview::simulation
