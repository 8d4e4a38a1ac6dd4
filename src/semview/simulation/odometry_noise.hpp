// SPDX-License-Identifier: Apache-2.0
/// Wheel odometry that drifts.
#pragma once

#include <span>
#include <vector>

#include "semview/core/random.hpp"
#include "semview/io/trajectory.hpp"

namespace semview::simulation {

/// Errors of one drive: constant ones, drawn once (a wheel's wear), and a random walk.
struct OdometryNoiseConfig {
  double distance_error = 0.02;    ///< relative, constant in a drive
  double turn_error = 0.02;        ///< relative, constant in a drive
  double veer_rad_per_m = 0.0105;  ///< turning that is not noticed (0.6°), constant in a drive
  double distance_walk_m = 0.01;   ///< σ of the random part after 1 m of way
  double turn_walk_rad = 0.01;     ///< σ of the random part after 1 m of way or 1 rad of turning
};

/// What odometry makes of a drive, starting at the pose (0, 0, 0) of its own frame, with the stamps
/// of `truth`. The constant errors are between 0.7 and 1.3 times those of `config`, of either sign;
/// `level` scales all errors: 0 gives the truth as seen from its own start.
std::vector<io::StampedPose2> simulate_odometry(std::span<const io::StampedPose2> truth,
                                                const OdometryNoiseConfig& config,
                                                double level,
                                                Rng& rng);

}  // namespace semview::simulation
