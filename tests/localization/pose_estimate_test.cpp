// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/pose_estimate.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "semview/localization/initialization.hpp"

namespace semview::localization {
namespace {

Particle at(double x_m, double y_m, double heading_rad, double weight) {
  return {{x_m, y_m, heading_rad}, heading_rad, true, weight};
}

TEST(PoseEstimateTest, HighestWeightTakesTheFirstOfEquals) {
  const ParticleSet particles{at(0, 0, 0, 0.2), at(1, 2, 0.5, 0.4), at(5, 5, 0, 0.4)};
  const PoseEstimate estimate = estimate_pose(particles, EstimateKind::kHighestWeight);
  EXPECT_EQ(estimate.map_from_robot, (Pose2{1, 2, 0.5}));
}

TEST(PoseEstimateTest, MeanOfHeadingsAcrossTheWrapIsNotZero) {
  const ParticleSet particles{at(0, 0, kPi - 0.1, 0.5), at(2, 4, -kPi + 0.1, 0.5)};
  const PoseEstimate estimate = estimate_pose(particles, EstimateKind::kWeightedMean);
  EXPECT_NEAR(estimate.map_from_robot.x_m, 1.0, 1e-12);
  EXPECT_NEAR(estimate.map_from_robot.y_m, 2.0, 1e-12);
  EXPECT_NEAR(std::abs(estimate.map_from_robot.yaw_rad), kPi, 1e-12);
  // Two directions at ±0.1 rad from their mean: |mean direction| = cos 0.1.
  EXPECT_NEAR(estimate.heading_sigma_rad, std::sqrt(-2.0 * std::log(std::cos(0.1))), 1e-12);
  EXPECT_NEAR(estimate.weight, 1.0, 1e-12);
}

TEST(PoseEstimateTest, StrongestModeIsNotTheMeanOfTwo) {
  Rng rng(4);
  ParticleSet particles = gaussian_particles({0, 0, 0.0}, 0.1, 0.05, 300, rng);
  const ParticleSet other = gaussian_particles({6, 1, 1.0}, 0.1, 0.05, 700, rng);
  particles.insert(particles.end(), other.begin(), other.end());
  for (Particle& particle : particles) particle.weight = 1e-3;
  const PoseEstimate estimate = estimate_pose(particles, EstimateKind::kStrongestMode);
  EXPECT_NEAR(estimate.map_from_robot.x_m, 6.0, 0.02);
  EXPECT_NEAR(estimate.map_from_robot.y_m, 1.0, 0.02);
  EXPECT_NEAR(estimate.map_from_robot.yaw_rad, 1.0, 0.02);
  EXPECT_NEAR(estimate.weight, 0.7, 0.01);
  EXPECT_NEAR(std::sqrt(estimate.var_x_m2), 0.1, 0.02);
}

TEST(PoseEstimateTest, HeadingsApartAreModesApartAtOnePlace) {
  ParticleSet particles;
  for (int i = 0; i < 6; ++i) particles.push_back(at(1, 1, kPi - 0.05 + 0.1 * (i % 2), 0.1));
  for (int i = 0; i < 4; ++i) particles.push_back(at(1, 1, 0.0, 0.1));
  const PoseEstimate estimate = estimate_pose(particles, EstimateKind::kStrongestMode);
  EXPECT_NEAR(estimate.weight, 0.6, 1e-9);
  EXPECT_NEAR(std::abs(estimate.map_from_robot.yaw_rad), kPi, 1e-9);
}

TEST(PoseEstimateTest, ModeOfOneParticleIsThatParticle) {
  const PoseEstimate estimate =
      estimate_pose({at(-3.3, 7.7, -2.0, 1.0)}, EstimateKind::kStrongestMode);
  EXPECT_NEAR(estimate.map_from_robot.x_m, -3.3, 1e-12);
  EXPECT_NEAR(estimate.map_from_robot.y_m, 7.7, 1e-12);
  EXPECT_NEAR(estimate.map_from_robot.yaw_rad, -2.0, 1e-12);
}

TEST(PoseEstimateTest, EllipseHasTheAxesOfItsCovariance) {
  // Variances 0.09 along 30° and 0.01 across it.
  const double yaw = rad_from_deg(30.0);
  const double c = std::cos(yaw);
  const double s = std::sin(yaw);
  PoseEstimate estimate;
  estimate.var_x_m2 = 0.09 * c * c + 0.01 * s * s;
  estimate.var_y_m2 = 0.09 * s * s + 0.01 * c * c;
  estimate.cov_xy_m2 = (0.09 - 0.01) * s * c;
  const Ellipse ellipse = position_ellipse(estimate);
  EXPECT_NEAR(ellipse.major_sigma_m, 0.3, 1e-12);
  EXPECT_NEAR(ellipse.minor_sigma_m, 0.1, 1e-12);
  EXPECT_NEAR(ellipse.major_yaw_rad, yaw, 1e-12);
}

}  // namespace
}  // namespace semview::localization
