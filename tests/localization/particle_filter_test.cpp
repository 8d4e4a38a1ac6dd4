// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/particle_filter.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "semview/localization/initialization.hpp"
#include "semview/localization/odometry_motion_model.hpp"
#include "semview/localization/pose_estimate.hpp"
#include "semview/localization/position_noise_model.hpp"

namespace semview::localization {
namespace {

/// A robot that measures its position and heading with Gaussian errors.
class Beacon final : public ObservationModel {
 public:
  Pose2 truth;
  double sigma_m = 0.2;
  double heading_sigma_rad = 0.1;

  Result<ObservationWeights> weigh(std::span<const Particle> particles) override {
    ObservationWeights weights;
    for (const Particle& particle : particles) {
      const Pose2& pose = particle.map_from_robot;
      const double distance = distance_m(pose, truth) / sigma_m;
      const double turn = wrap_angle(pose.yaw_rad - truth.yaw_rad) / heading_sigma_rad;
      weights.log_weights.push_back(-0.5 * (distance * distance + turn * turn));
    }
    return weights;
  }
};

/// One that always answers the same thing.
class Constant final : public ObservationModel {
 public:
  Result<ObservationWeights> answer;
  Result<ObservationWeights> weigh(std::span<const Particle>) override { return answer; }
};

const Pose2 kStep{0.3, 0.0, 0.1};

ParticleFilter filter_at(const Pose2& start, std::uint64_t seed, double threshold = 0.5) {
  Rng rng(seed, "initialization");
  return ParticleFilter({.resample_threshold = threshold},
                        std::make_shared<OdometryMotionModel>(OdometryMotionConfig{}),
                        gaussian_particles(start, 0.5, 0.2, 500, rng),
                        seed);
}

TEST(ParticleFilterTest, AStepIsAsLongAsTheDistortedMapDrawsIt) {
  ParticleSet particles(1);
  particles[0].weight = 1.0;
  particles[0].map_from_robot = {1.0, 2.0, kPi / 2.0};
  particles[0].affine = {.a = 0.5, .b = 2.0, .k = 0.3};
  PositionNoiseConfig noise;
  noise.sigma_m = 0.0;
  noise.heading_sigma_rad = 0.0;
  ParticleFilter filter({}, std::make_shared<PositionNoiseModel>(noise), particles, 1);
  filter.predict({1.0, -1.0, 0.0});  // in the map's axes: 1 m along x, 1 m along y
  EXPECT_NEAR(filter.particles()[0].map_from_robot.x_m, 1.0 + 0.5, 1e-12);
  EXPECT_NEAR(filter.particles()[0].map_from_robot.y_m, 2.0 + 0.3 + 2.0, 1e-12);
}

TEST(ParticleFilterTest, ConvergesOnABeacon) {
  Beacon beacon;
  beacon.truth = {1.0, 2.0, 0.5};
  ParticleFilter filter = filter_at({1.4, 1.7, 0.4}, 11);
  for (int i = 0; i < 20; ++i) {
    beacon.truth = beacon.truth * kStep;
    filter.predict(kStep);
    ASSERT_TRUE(filter.update(beacon));
    filter.resample_if_needed();
  }
  const PoseEstimate estimate = estimate_pose(filter.particles(), EstimateKind::kWeightedMean);
  // The posterior's own spread: 20 fixes of 0.2 m against odometry noise of centimetres a step.
  EXPECT_LT(distance_m(estimate.map_from_robot, beacon.truth), 0.05);
  EXPECT_LT(std::abs(wrap_angle(estimate.map_from_robot.yaw_rad - beacon.truth.yaw_rad)), 0.05);
  EXPECT_LT(std::sqrt(estimate.var_x_m2), 0.15);
}

TEST(ParticleFilterTest, LinearCaseAgreesWithTheKalmanFilter) {
  // Position noise and a Gaussian fix: the exact posterior is known.
  const double prior = 0.4, step_sigma = 0.3, fix_sigma = 0.25;
  Rng rng(3, "initialization");
  constexpr std::size_t kCount = 40000;
  ParticleFilter filter({.resample_threshold = 0.0},
                        std::make_shared<PositionNoiseModel>(PositionNoiseConfig{step_sigma, 0.0}),
                        gaussian_particles({0, 0, 0}, prior, 0.0, kCount, rng),
                        3);
  Beacon beacon;
  beacon.truth = {1.5, -0.2, 0.0};
  beacon.sigma_m = fix_sigma;
  filter.predict({1.0, 0.0, 0.0});
  const auto report = filter.update(beacon);
  ASSERT_TRUE(report);
  const double predicted = prior * prior + step_sigma * step_sigma;
  const double gain = predicted / (predicted + fix_sigma * fix_sigma);
  const double posterior = (1.0 - gain) * predicted;
  const PoseEstimate estimate = estimate_pose(filter.particles(), EstimateKind::kWeightedMean);
  const double error = 4.0 / std::sqrt(report->effective_sample_size);
  EXPECT_NEAR(estimate.map_from_robot.x_m, 1.0 + gain * 0.5, std::sqrt(posterior) * error);
  EXPECT_NEAR(estimate.map_from_robot.y_m, -gain * 0.2, std::sqrt(posterior) * error);
  EXPECT_NEAR(estimate.var_x_m2, posterior, 2.0 * posterior * error);
}

TEST(ParticleFilterTest, SameSeedSameParticlesOtherSeedOthers) {
  auto run = [](std::uint64_t seed) {
    Beacon beacon;
    beacon.truth = {1, 1, 0};
    ParticleFilter filter = filter_at({1, 1, 0}, seed, 1.0);
    for (int i = 0; i < 3; ++i) {
      filter.predict(kStep);
      EXPECT_TRUE(filter.update(beacon));
      filter.resample_if_needed();
    }
    return filter.particles();
  };
  EXPECT_EQ(run(5), run(5));
  EXPECT_NE(run(5), run(6));
}

TEST(ParticleFilterTest, PredictionAloneIsDeadReckoningOnAverage) {
  ParticleFilter filter = filter_at({0, 0, 0}, 2);
  Pose2 expected;
  for (int i = 0; i < 10; ++i) {
    filter.predict({0.2, 0.0, 0.0});
    expected = expected * Pose2{0.2, 0.0, 0.0};
  }
  const PoseEstimate estimate = estimate_pose(filter.particles(), EstimateKind::kWeightedMean);
  EXPECT_LT(distance_m(estimate.map_from_robot, expected), 0.15);
}

TEST(ParticleFilterTest, FailedObservationLeavesTheParticlesAsPredicted) {
  ParticleFilter filter = filter_at({0, 0, 0}, 2);
  filter.predict(kStep);
  const ParticleSet before = filter.particles();
  Constant model;
  model.answer = fail(ErrorCode::kUnavailable, "gone");
  const auto report = filter.update(model);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kUnavailable);
  EXPECT_EQ(filter.particles(), before);
}

TEST(ParticleFilterTest, UselessWeightsAreReportedAndChangeNothing) {
  ParticleFilter filter = filter_at({0, 0, 0}, 2);
  const ParticleSet before = filter.particles();
  Constant model;
  ObservationWeights weights;
  weights.log_weights.assign(before.size(), std::numeric_limits<double>::quiet_NaN());
  weights.headings_rad.assign(before.size(), 1.0);
  model.answer = weights;
  const auto report = filter.update(model);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->outcome, WeightOutcome::kUninformative);
  EXPECT_EQ(filter.particles(), before);
  EXPECT_FALSE(filter.resample_if_needed());
}

TEST(ParticleFilterTest, AnAnswerOfAnotherSizeIsAnError) {
  ParticleFilter filter = filter_at({0, 0, 0}, 2);
  Constant model;
  model.answer = ObservationWeights{{1.0}, {}};
  EXPECT_FALSE(filter.update(model));
}

TEST(ParticleFilterTest, ResamplesBelowTheThresholdOnly) {
  Beacon beacon;
  beacon.sigma_m = 0.05;
  ParticleFilter never = filter_at({0, 0, 0}, 2, 0.0);
  ParticleFilter half = filter_at({0, 0, 0}, 2, 0.5);
  EXPECT_FALSE(half.resample_if_needed());
  ASSERT_TRUE(never.update(beacon));
  ASSERT_TRUE(half.update(beacon));
  EXPECT_FALSE(never.resample_if_needed());
  EXPECT_TRUE(half.resample_if_needed());
  EXPECT_NEAR(effective_sample_size(half.particles()), 500.0, 1e-6);
  ParticleFilter always = filter_at({0, 0, 0}, 2, 1.0);
  EXPECT_TRUE(always.resample_if_needed());
}

TEST(CompassTest, CorrectsAShareOfSmallDifferencesAndTakesOverUnknownYaws) {
  ParticleSet particles(4);
  for (Particle& particle : particles) particle.map_from_robot.yaw_rad = 3.1;
  particles[2].yaw_known = false;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> readings{-3.1, 1.0, 1.0, nan};
  apply_compass(particles, readings, {.gain = 0.5, .gate_rad = 0.3});
  EXPECT_NEAR(std::abs(particles[0].map_from_robot.yaw_rad), kPi, 1e-12);
  EXPECT_EQ(particles[0].heading_rad, -3.1);
  EXPECT_EQ(particles[1].map_from_robot.yaw_rad, 3.1);
  EXPECT_EQ(particles[1].heading_rad, 1.0);
  EXPECT_EQ(particles[2].map_from_robot.yaw_rad, 1.0);
  EXPECT_TRUE(particles[2].yaw_known);
  EXPECT_EQ(particles[3].map_from_robot.yaw_rad, 3.1);
  EXPECT_EQ(particles[3].heading_rad, 0.0);
}

TEST(CompassTest, ReportedHeadingFollowsOdometryBetweenReadings) {
  ParticleSet particles(1);
  particles[0] = {{0, 0, 0.2}, 1.0, true, 1.0};
  ParticleFilter filter(
      {}, std::make_shared<OdometryMotionModel>(OdometryMotionConfig{0, 0, 0, 0}), particles, 1);
  filter.predict({1.0, 0.0, 0.5});
  EXPECT_NEAR(filter.particles()[0].heading_rad, 1.5, 1e-12);
  // The step is turned by the pose's own yaw.
  EXPECT_NEAR(filter.particles()[0].map_from_robot.x_m, std::cos(0.2), 1e-12);
}

}  // namespace
}  // namespace semview::localization
