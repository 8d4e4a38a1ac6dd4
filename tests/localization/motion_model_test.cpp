// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "semview/localization/odometry_motion_model.hpp"
#include "semview/localization/position_noise_model.hpp"

namespace semview::localization {
namespace {

constexpr int kSamples = 40000;
// Four standard errors: a right model fails one check in 16 000.
constexpr double kErrors = 4.0;

struct Moments {
  double mean = 0.0;
  double variance = 0.0;
};

Moments moments(const std::vector<double>& values) {
  Moments result;
  for (const double value : values) result.mean += value / kSamples;
  for (const double value : values) {
    result.variance += (value - result.mean) * (value - result.mean) / kSamples;
  }
  return result;
}

double mean_tolerance(double variance) { return kErrors * std::sqrt(variance / kSamples); }
// The standard error of a sample variance of a normal variable is σ² sqrt(2/n).
double variance_tolerance(double variance) {
  return kErrors * variance * std::sqrt(2.0 / kSamples);
}

struct Samples {
  std::vector<double> x, y, yaw;
};

Samples draw(const MotionModel& model, const Pose2& from, const Pose2& step) {
  Rng rng(7, "test");
  Samples samples;
  for (int i = 0; i < kSamples; ++i) {
    const Pose2 pose = model.sample(from, step, rng);
    samples.x.push_back(pose.x_m);
    samples.y.push_back(pose.y_m);
    samples.yaw.push_back(wrap_angle(pose.yaw_rad - from.yaw_rad - step.yaw_rad));
  }
  return samples;
}

TEST(OdometryMotionModelTest, WithoutNoiseIsComposition) {
  const OdometryMotionModel model({0.0, 0.0, 0.0, 0.0});
  Rng rng(1);
  const Pose2 from{3.0, -2.0, 2.5};
  for (const Pose2& step :
       {Pose2{0.5, 0.1, 0.3}, Pose2{-0.5, 0.0, 0.0}, Pose2{0.0, 0.0, -3.0}, Pose2{0.0, 0.3, 1.0}}) {
    const Pose2 sampled = model.sample(from, step, rng);
    const Pose2 expected = from * step;
    EXPECT_NEAR(sampled.x_m, expected.x_m, 1e-12);
    EXPECT_NEAR(sampled.y_m, expected.y_m, 1e-12);
    EXPECT_NEAR(wrap_angle(sampled.yaw_rad - expected.yaw_rad), 0.0, 1e-12);
  }
}

TEST(OdometryMotionModelTest, StraightStepHasTheMomentsOfTheClosedForm) {
  // Way d̂ ~ N(d, a3 d²), course φ ~ N(0, a2 d²), second rotation ~ N(0, a2 d²), independent:
  // E x = d e^{-v/2}, E x² = (d² + a3 d²)(1 + e^{-2v})/2, E y² with a minus sign; v = a2 d².
  const double d = 1.5;
  const double a2 = 0.02;
  const double a3 = 0.04;
  const double v = a2 * d * d;
  const OdometryMotionModel model({0.5, a2, a3, 0.5});
  const Samples samples = draw(model, Pose2{}, Pose2{d, 0.0, 0.0});

  const double mean_x = d * std::exp(-v / 2.0);
  const double var_x = d * d * (1.0 + a3) * (1.0 + std::exp(-2.0 * v)) / 2.0 - mean_x * mean_x;
  const double var_y = d * d * (1.0 + a3) * (1.0 - std::exp(-2.0 * v)) / 2.0;
  EXPECT_NEAR(moments(samples.x).mean, mean_x, mean_tolerance(var_x));
  EXPECT_NEAR(moments(samples.y).mean, 0.0, mean_tolerance(var_y));
  EXPECT_NEAR(moments(samples.x).variance, var_x, 1.5 * variance_tolerance(var_x));
  EXPECT_NEAR(moments(samples.y).variance, var_y, 1.5 * variance_tolerance(var_y));
  EXPECT_NEAR(moments(samples.yaw).mean, 0.0, mean_tolerance(2.0 * v));
  EXPECT_NEAR(moments(samples.yaw).variance, 2.0 * v, variance_tolerance(2.0 * v));
}

TEST(OdometryMotionModelTest, TurnOnTheSpotNoisesHeadingByAlpha1AndPositionByAlpha4) {
  const double turn = 0.8;
  const OdometryMotionModel model({0.05, 9.0, 9.0, 0.01});
  const Samples samples = draw(model, Pose2{}, Pose2{0.0, 0.0, turn});
  const double var_yaw = 0.05 * turn * turn;
  const double var_way = 0.01 * turn * turn;
  EXPECT_NEAR(moments(samples.yaw).variance, var_yaw, variance_tolerance(var_yaw));
  EXPECT_NEAR(moments(samples.x).variance, var_way, variance_tolerance(var_way));
}

TEST(OdometryMotionModelTest, DrivingBackwardsIsNotAHalfTurnForTheNoise) {
  const OdometryMotionModel model({1.0, 0.0, 0.0, 0.0});
  const Samples samples = draw(model, Pose2{}, Pose2{-0.5, 0.0, 0.0});
  EXPECT_NEAR(moments(samples.yaw).variance, 0.0, 1e-20);
  EXPECT_NEAR(moments(samples.x).mean, -0.5, 1e-12);
}

TEST(PositionNoiseModelTest, HasItsSigmaInXAndYWhateverTheStep) {
  const PositionNoiseModel model({0.5, 0.1});
  for (const Pose2& step : {Pose2{}, Pose2{2.0, 1.0, 0.5}}) {
    const Pose2 from{1.0, 2.0, 3.0};
    const Pose2 expected = from * step;
    const Samples samples = draw(model, from, step);
    EXPECT_NEAR(moments(samples.x).mean, expected.x_m, mean_tolerance(0.25));
    EXPECT_NEAR(moments(samples.y).mean, expected.y_m, mean_tolerance(0.25));
    EXPECT_NEAR(moments(samples.x).variance, 0.25, variance_tolerance(0.25));
    EXPECT_NEAR(moments(samples.y).variance, 0.25, variance_tolerance(0.25));
    EXPECT_NEAR(moments(samples.yaw).variance, 0.01, variance_tolerance(0.01));
  }
}

TEST(MotionModelTest, ParametersOutOfRangeAreNamed) {
  EXPECT_EQ(validate(OdometryMotionConfig{0.1, -1.0, 0.1, 0.1}).error().field, "alpha2");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(validate(PositionNoiseConfig{nan, 0.1}).error().field, "sigma_m");
  EXPECT_TRUE(validate(OdometryMotionConfig{}));
  EXPECT_TRUE(validate(PositionNoiseConfig{}));
}

}  // namespace
}  // namespace semview::localization
