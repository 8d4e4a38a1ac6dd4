// SPDX-License-Identifier: Apache-2.0
#include "semview/geometry/angle.hpp"

#include <gtest/gtest.h>

namespace semview {
namespace {

TEST(WrapAngleTest, HalfATurnIsPlusPiFromBothSides) {
  EXPECT_EQ(wrap_angle(kPi), kPi);
  EXPECT_EQ(wrap_angle(-kPi), kPi);
}

TEST(WrapAngleTest, KeepsTheDirection) {
  for (double angle = -20.0; angle <= 20.0; angle += 0.37) {
    const double wrapped = wrap_angle(angle);
    EXPECT_GT(wrapped, -kPi);
    EXPECT_LE(wrapped, kPi);
    EXPECT_NEAR(std::sin(wrapped), std::sin(angle), 1e-14);
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1e-14);
  }
}

TEST(AngleTest, DegreesAndRadiansAreInverse) {
  EXPECT_EQ(rad_from_deg(180.0), kPi);
  EXPECT_DOUBLE_EQ(deg_from_rad(rad_from_deg(33.3)), 33.3);
}

}  // namespace
}  // namespace semview
