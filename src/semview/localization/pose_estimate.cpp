// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/pose_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "semview/core/check.hpp"

namespace semview::localization {
namespace {

using Bin = std::tuple<std::int64_t, std::int64_t, std::int64_t>;  // y, x, heading

constexpr int kMeanShifts = 10;

double squared_distance(const Pose2& a, const Pose2& b) {
  const double dx = a.x_m - b.x_m;
  const double dy = a.y_m - b.y_m;
  return dx * dx + dy * dy;
}

bool belongs(const Pose2& center, const Particle& particle, const ModeConfig& mode) {
  return squared_distance(center, particle.map_from_robot) <= mode.radius_m * mode.radius_m &&
         std::abs(wrap_angle(particle.heading_rad - center.yaw_rad)) <= mode.heading_radius_rad;
}

/// Mean and spread of the particles that `included` accepts; weight 0 if it accepts none.
template <typename Included>
PoseEstimate summarize(const ParticleSet& particles, const Included& included) {
  PoseEstimate estimate;
  double all = 0.0;
  double cosine = 0.0;
  double sine = 0.0;
  Pose2& mean = estimate.map_from_robot;
  for (const Particle& particle : particles) {
    all += particle.weight;
    if (!included(particle)) continue;
    estimate.weight += particle.weight;
    mean.x_m += particle.weight * particle.map_from_robot.x_m;
    mean.y_m += particle.weight * particle.map_from_robot.y_m;
    cosine += particle.weight * std::cos(particle.heading_rad);
    sine += particle.weight * std::sin(particle.heading_rad);
  }
  if (!(estimate.weight > 0.0)) return estimate;
  mean.x_m /= estimate.weight;
  mean.y_m /= estimate.weight;
  mean.yaw_rad = wrap_angle(std::atan2(sine, cosine));
  for (const Particle& particle : particles) {
    if (!included(particle)) continue;
    const double share = particle.weight / estimate.weight;
    const double dx = particle.map_from_robot.x_m - mean.x_m;
    const double dy = particle.map_from_robot.y_m - mean.y_m;
    estimate.var_x_m2 += share * dx * dx;
    estimate.cov_xy_m2 += share * dx * dy;
    estimate.var_y_m2 += share * dy * dy;
  }
  const double concentration = std::min(1.0, std::hypot(cosine, sine) / estimate.weight);
  estimate.heading_sigma_rad = std::sqrt(std::max(0.0, -2.0 * std::log(concentration)));
  estimate.weight /= all;
  return estimate;
}

/// The centre of the bin that holds the most weight together with its neighbours: where to start
/// the search of the mode. Bins are half a radius wide; ties take the lowest bin.
Pose2 heaviest_neighbourhood(const ParticleSet& particles, const ModeConfig& mode) {
  const double size_m = mode.radius_m / 2.0;
  const auto headings =
      std::max(std::int64_t{1}, static_cast<std::int64_t>(kTwoPi / mode.heading_radius_rad * 2.0));
  const double heading_size_rad = kTwoPi / static_cast<double>(headings);
  std::map<Bin, double> bins;
  for (const Particle& particle : particles) {
    const double turn = (particle.heading_rad + kPi) / heading_size_rad;
    bins[{static_cast<std::int64_t>(std::floor(particle.map_from_robot.y_m / size_m)),
          static_cast<std::int64_t>(std::floor(particle.map_from_robot.x_m / size_m)),
          std::min(static_cast<std::int64_t>(turn), headings - 1)}] += particle.weight;
  }
  Bin best;
  double best_weight = -1.0;
  for (const auto& entry : bins) {
    const auto [y, x, heading] = entry.first;
    double weight = 0.0;
    for (std::int64_t dy = -1; dy <= 1; ++dy) {
      for (std::int64_t dx = -1; dx <= 1; ++dx) {
        // With fewer than three bins around the circle a neighbour must not count twice.
        const std::int64_t reach = headings >= 3 ? 1 : 0;
        for (std::int64_t turn = -reach; turn <= reach; ++turn) {
          const auto found = bins.find({y + dy, x + dx, (heading + turn + headings) % headings});
          if (found != bins.end()) weight += found->second;
        }
      }
    }
    if (weight > best_weight) {
      best_weight = weight;
      best = entry.first;
    }
  }
  return {(static_cast<double>(std::get<1>(best)) + 0.5) * size_m,
          (static_cast<double>(std::get<0>(best)) + 0.5) * size_m,
          wrap_angle((static_cast<double>(std::get<2>(best)) + 0.5) * heading_size_rad - kPi)};
}

/// Mean shift with a flat kernel (Comaniciu, Meer 2002) from the heaviest neighbourhood.
PoseEstimate strongest_mode(const ParticleSet& particles, const ModeConfig& mode) {
  Pose2 center = heaviest_neighbourhood(particles, mode);
  PoseEstimate estimate;
  for (int shift = 0; shift < kMeanShifts; ++shift) {
    const PoseEstimate next = summarize(
        particles, [&](const Particle& particle) { return belongs(center, particle, mode); });
    if (!(next.weight > 0.0)) break;
    const bool settled = next.map_from_robot == center;
    estimate = next;
    center = next.map_from_robot;
    if (settled) break;
  }
  if (estimate.weight > 0.0) return estimate;
  return summarize(particles, [](const Particle&) { return true; });
}

}  // namespace

PoseEstimate estimate_pose(const ParticleSet& particles,
                           EstimateKind kind,
                           const ModeConfig& mode) {
  SEMVIEW_CHECK(!particles.empty());
  if (kind == EstimateKind::kStrongestMode) return strongest_mode(particles, mode);
  PoseEstimate estimate = summarize(particles, [](const Particle&) { return true; });
  if (kind == EstimateKind::kHighestWeight) {
    const auto best = std::max_element(
        particles.begin(), particles.end(), [](const Particle& a, const Particle& b) {
          return a.weight < b.weight;
        });
    estimate.map_from_robot = best->reported_pose();
  }
  return estimate;
}

Ellipse position_ellipse(const PoseEstimate& estimate) {
  const double half_sum = (estimate.var_x_m2 + estimate.var_y_m2) / 2.0;
  const double half_difference = (estimate.var_x_m2 - estimate.var_y_m2) / 2.0;
  const double radius = std::hypot(half_difference, estimate.cov_xy_m2);
  Ellipse ellipse;
  ellipse.major_sigma_m = std::sqrt(half_sum + radius);
  ellipse.minor_sigma_m = std::sqrt(std::max(0.0, half_sum - radius));
  ellipse.major_yaw_rad = 0.5 * std::atan2(estimate.cov_xy_m2, half_difference);
  return ellipse;
}

}  // namespace semview::localization
