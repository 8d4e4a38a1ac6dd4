// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/initialization.hpp"

#include <algorithm>
#include <cmath>

#include "semview/core/check.hpp"

namespace semview::localization {

ParticleSet gaussian_particles(
    const Pose2& mean, double sigma_m, double heading_sigma_rad, std::size_t count, Rng& rng) {
  ParticleSet particles(count);
  for (Particle& particle : particles) {
    particle.map_from_robot.x_m = rng.normal(mean.x_m, sigma_m);
    particle.map_from_robot.y_m = rng.normal(mean.y_m, sigma_m);
    particle.map_from_robot.yaw_rad = wrap_angle(rng.normal(mean.yaw_rad, heading_sigma_rad));
    particle.heading_rad = particle.map_from_robot.yaw_rad;
    particle.weight = 1.0 / static_cast<double>(count);
  }
  return particles;
}

ParticleSet uniform_particles(std::span<const CellIndex> free_cells, std::size_t count, Rng& rng) {
  SEMVIEW_CHECK(!free_cells.empty());
  ParticleSet particles(count);
  const double cells_a_particle =
      static_cast<double>(free_cells.size()) / static_cast<double>(count);
  const double first = rng.uniform();
  for (std::size_t i = 0; i < count; ++i) {
    const double mark = (first + static_cast<double>(i)) * cells_a_particle;
    const std::size_t index = std::min(static_cast<std::size_t>(mark), free_cells.size() - 1);
    const Pose2 center = PoseGrid::center(free_cells[index]);
    constexpr double kHalf_m = PoseGrid::kCellSize_m / 2.0;
    Particle& particle = particles[i];
    particle.map_from_robot.x_m = center.x_m + rng.uniform(-kHalf_m, kHalf_m);
    particle.map_from_robot.y_m = center.y_m + rng.uniform(-kHalf_m, kHalf_m);
    particle.map_from_robot.yaw_rad = wrap_angle(rng.uniform(-kPi, kPi));
    particle.heading_rad = particle.map_from_robot.yaw_rad;
    particle.yaw_known = false;
    particle.weight = 1.0 / static_cast<double>(count);
  }
  return particles;
}

}  // namespace semview::localization
