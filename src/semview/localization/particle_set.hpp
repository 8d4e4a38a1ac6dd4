// SPDX-License-Identifier: Apache-2.0
/// The samples of the belief, and what follows from their weights alone.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "semview/geometry/affine.hpp"
#include "semview/geometry/pose2.hpp"

namespace semview::localization {

/// One hypothesis of where the robot is.
struct Particle {
  /// The pose in the map. Its yaw is the one that odometry steps are turned by.
  Pose2 map_from_robot = {};
  /// The heading to report: with a visual compass the one it chose, else the yaw of the pose.
  double heading_rad = 0.0;
  /// False until a first compass reading, for a particle that was thrown in without any idea of its
  /// direction.
  bool yaw_known = true;
  double weight = 0.0;
  /// How the map is distorted, if it may be: the position is in the drawn map, the yaw in the true
  /// world, and odometry's steps are true metres.
  MapAffine affine = {};

  /// Position and reported heading.
  Pose2 reported_pose() const { return {map_from_robot.x_m, map_from_robot.y_m, heading_rad}; }

  bool operator==(const Particle&) const = default;
};

/// Weights are >= 0, finite, and sum to 1 up to rounding.
using ParticleSet = std::vector<Particle>;

/// How a set of weights came out of its update.
enum class WeightOutcome {
  kUsed,           ///< at least one particle is possible: weights are the posterior
  kUninformative,  ///< no particle is possible, or no number was usable: weights are as before
};

/// Bayes' rule: weight · exp(log_weight), normalised in logarithms so that nothing underflows.
///
/// -∞ makes a particle impossible, and so do NaN and +∞, which are nobody's likelihood. If no
/// particle is left possible the observation says nothing that the filter could use, and the
/// weights stay as they were.
/// @param log_weights  one a particle; any common offset cancels
WeightOutcome multiply_weights(ParticleSet& particles, std::span<const double> log_weights);

/// N_eff = 1 / Σ w², between 1 and the number of particles.
/// @source Doucet, de Freitas, Gordon 2001; the trigger of resampling.
double effective_sample_size(const ParticleSet& particles);

}  // namespace semview::localization
