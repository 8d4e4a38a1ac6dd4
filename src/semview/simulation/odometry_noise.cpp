// SPDX-License-Identifier: Apache-2.0
#include "semview/simulation/odometry_noise.hpp"

#include <cmath>
#include <limits>

namespace semview::simulation {
namespace {

constexpr double kMinScale = 0.25;
constexpr double kMaxScale = 4.0;
constexpr double kScaleStep = 1.05;

/// The drive with all errors scaled; the same stream gives the same errors but for their size.
std::vector<io::StampedPose2> with_errors(std::span<const io::StampedPose2> truth,
                                          const OdometryNoiseConfig& config,
                                          double scale,
                                          Rng& rng) {
  // Never near zero: a drive whose odometry happens to be right would test nothing.
  const auto constant = [&](double size) {
    const double sign = rng.below(2) == 0 ? -1.0 : 1.0;
    return scale * size * sign * rng.uniform(0.7, 1.3);
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
      // Variances grow with the way, so the errors do not depend on the rate of the odometry.
      const double walk_m = scale * config.distance_walk_m * std::sqrt(way_m);
      const double walk_rad =
          scale * config.turn_walk_rad * std::sqrt(way_m + std::abs(step.yaw_rad));
      const double along_m = rng.normal(0.0, walk_m);
      const double across_m = rng.normal(0.0, 0.5 * walk_m);
      const double turned_rad = rng.normal(0.0, walk_rad);
      odom_from_base = odom_from_base * Pose2{step.x_m * (1.0 + distance_error) + along_m,
                                              step.y_m + across_m,
                                              step.yaw_rad * (1.0 + turn_error) +
                                                  veer_rad_per_m * way_m + turned_rad};
    }
    odometry.push_back({truth[k].stamp_s, odom_from_base});
  }
  return odometry;
}

double final_error_m(std::span<const io::StampedPose2> truth,
                     std::span<const io::StampedPose2> odometry) {
  return distance_m(truth.front().pose * odometry.back().pose, truth.back().pose);
}

}  // namespace

std::vector<io::StampedPose2> simulate_odometry(std::span<const io::StampedPose2> truth,
                                                const OdometryNoiseConfig& config,
                                                double level,
                                                Rng& rng) {
  if (truth.empty()) return {};
  double way_m = 0.0;
  for (std::size_t k = 1; k < truth.size(); ++k)
    way_m += distance_m(truth[k - 1].pose, truth[k].pose);
  const double wanted_m = level * config.drift_share * way_m * rng.uniform(2.0 / 3.0, 4.0 / 3.0);
  if (!(wanted_m > 0.0)) return with_errors(truth, config, level, rng);
  // The error does not grow evenly with the scale: try them all.
  double best_scale = 1.0;
  double best_miss_m = std::numeric_limits<double>::infinity();
  for (double scale = kMinScale; scale <= kMaxScale; scale *= kScaleStep) {
    Rng trial = rng;
    const double error_m = final_error_m(truth, with_errors(truth, config, level * scale, trial));
    const double miss_m = std::abs(error_m - wanted_m);
    if (miss_m < best_miss_m) {
      best_miss_m = miss_m;
      best_scale = scale;
    }
  }
  return with_errors(truth, config, level * best_scale, rng);
}

}  // namespace semview::simulation
