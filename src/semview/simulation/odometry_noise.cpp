// SPDX-License-Identifier: Apache-2.0
#include "semview/simulation/odometry_noise.hpp"

#include <cmath>

namespace semview::simulation {

std::vector<io::StampedPose2> simulate_odometry(std::span<const io::StampedPose2> truth,
                                                const OdometryNoiseConfig& config,
                                                double level,
                                                Rng& rng) {
  // Never near zero: a drive whose odometry happens to be right would test nothing.
  const auto constant = [&](double size) {
    const double sign = rng.below(2) == 0 ? -1.0 : 1.0;
    return level * size * sign * rng.uniform(0.7, 1.3);
  };
  const double distance_error = constant(config.distance_error);
  const double turn_error = constant(config.turn_error);
  const double veer_rad_per_m = constant(config.veer_rad_per_m);
  std::vector<io::StampedPose2> odometry;
  Pose2 odom_from_base;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    if (k > 0) {
      const Pose2 step = inverse(truth[k - 1].pose) * truth[k].pose;
      const double way_m = std::hypot(step.x_m, step.y_m);
      const double turned_rad = std::abs(step.yaw_rad);
      // Variances grow with the way, so the errors do not depend on the rate of the odometry.
      const double along_m = level * rng.normal(0.0, config.distance_walk_m * std::sqrt(way_m));
      const double across_m =
          level * rng.normal(0.0, 0.5 * config.distance_walk_m * std::sqrt(way_m));
      const double turn_rad =
          level * rng.normal(0.0, config.turn_walk_rad * std::sqrt(way_m + turned_rad));
      odom_from_base = odom_from_base *
                       Pose2{step.x_m * (1.0 + distance_error) + along_m,
                             step.y_m + across_m,
                             step.yaw_rad * (1.0 + turn_error) + veer_rad_per_m * way_m + turn_rad};
    }
    odometry.push_back({truth[k].stamp_s, odom_from_base});
  }
  return odometry;
}

}  // namespace semview::simulation
