// SPDX-License-Identifier: Apache-2.0
/// First particles: around a known pose, or all over the building.
#pragma once

#include <cstddef>
#include <span>

#include "semview/core/random.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/localization/particle_set.hpp"

namespace semview::localization {

/// `count` > 0 particles of equal weight around `mean`; σ of x, y (m) and yaw (rad), >= 0.
ParticleSet gaussian_particles(
    const Pose2& mean, double sigma_m, double heading_sigma_rad, std::size_t count, Rng& rng);

/// `count` > 0 particles of equal weight, uniform over the cells (not empty), with uniform yaw that
/// counts as unknown. Systematic over the cells: with as many particles as cells each gets one.
ParticleSet uniform_particles(std::span<const CellIndex> free_cells, std::size_t count, Rng& rng);

}  // namespace semview::localization
