// SPDX-License-Identifier: Apache-2.0
/// One pose out of many particles.
#pragma once

#include "semview/localization/particle_set.hpp"

namespace semview::localization {

enum class EstimateKind {
  kHighestWeight,  ///< the particle of highest weight, ties: the first (the 2017 paper's choice)
  kWeightedMean,   ///< the mean of all, headings as directions; meaningless between two modes
  kStrongestMode,  ///< the mean of the particles of the strongest mode
};

/// How the strongest mode is found.
struct ModeConfig {
  double radius_m = 0.5;  ///< particles this near to the mode's centre belong to it
  double heading_radius_rad = kPi * 2.0 / 9.0;  ///< and this near in heading; π takes every heading
};

/// A pose with its uncertainty.
struct PoseEstimate {
  Pose2 map_from_robot;
  // Spread of the particles that the estimate speaks for: all of them, or those of the mode.
  double var_x_m2 = 0.0;
  double cov_xy_m2 = 0.0;
  double var_y_m2 = 0.0;
  double heading_sigma_rad = 0.0;  ///< circular: sqrt(-2 ln |mean direction|)
  double weight = 0.0;             ///< share of the belief that the estimate speaks for
};

/// The one-sigma ellipse of an estimate's position.
struct Ellipse {
  double major_sigma_m = 0.0;
  double minor_sigma_m = 0.0;
  double major_yaw_rad = 0.0;  ///< direction of the major axis in the map, in (-π/2, π/2]
};

/// @param particles  not empty, weights with a sum > 0
/// @cost O(particles) for each; the mode has a constant of about twenty.
PoseEstimate estimate_pose(const ParticleSet& particles,
                           EstimateKind kind,
                           const ModeConfig& mode = {});

Ellipse position_ellipse(const PoseEstimate& estimate);

}  // namespace semview::localization
