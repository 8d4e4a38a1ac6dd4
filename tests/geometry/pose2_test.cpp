// SPDX-License-Identifier: Apache-2.0
#include "semview/geometry/pose2.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace semview {
namespace {

void expect_near(const Pose2& a, const Pose2& b) {
  EXPECT_NEAR(a.x_m, b.x_m, 1e-12);
  EXPECT_NEAR(a.y_m, b.y_m, 1e-12);
  EXPECT_NEAR(wrap_angle(a.yaw_rad - b.yaw_rad), 0.0, 1e-12);
}

TEST(Pose2Test, AStepForwardGoesAlongTheHeading) {
  const Pose2 map_from_robot{1.0, 2.0, kPi / 2.0};
  expect_near(map_from_robot * Pose2{3.0, 0.0, 0.0}, {1.0, 5.0, kPi / 2.0});
  expect_near(map_from_robot * Pose2{0.0, 1.0, 0.0}, {0.0, 2.0, kPi / 2.0});
}

TEST(Pose2Test, TheInverseUndoesAndCompositionIsAssociative) {
  const Pose2 a{1.5, -2.0, 2.9};
  const Pose2 b{-0.3, 0.8, -1.2};
  const Pose2 c{4.0, 1.0, 0.7};
  expect_near(a * inverse(a), {});
  expect_near(inverse(a) * a, {});
  expect_near((a * b) * c, a * (b * c));
}

TEST(Pose2Test, YawStaysWrapped) {
  EXPECT_NEAR((Pose2{0.0, 0.0, 3.0} * Pose2{0.0, 0.0, 3.0}).yaw_rad, 6.0 - kTwoPi, 1e-12);
}

TEST(Pose2Test, FiniteMeansEveryNumber) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(is_finite({1.0, 2.0, 3.0}));
  EXPECT_FALSE(is_finite({kNan, 0.0, 0.0}));
  EXPECT_FALSE(is_finite({0.0, std::numeric_limits<double>::infinity(), 0.0}));
  EXPECT_FALSE(is_finite({0.0, 0.0, kNan}));
}

}  // namespace
}  // namespace semview
