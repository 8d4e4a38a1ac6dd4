// SPDX-License-Identifier: Apache-2.0
#include "semview/evaluation/depth_residuals.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace semview::evaluation {
namespace {

Image<float> row(std::initializer_list<float> pixels) {
  Image<float> image(1, static_cast<int>(pixels.size()));
  std::copy(pixels.begin(), pixels.end(), image.pixels().begin());
  return image;
}

TEST(DepthResidualsTest, ComparesWhereBothHaveADepth) {
  constexpr float kNone = std::numeric_limits<float>::infinity();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  DepthResiduals residuals;
  add_residuals(
      row({0.0F, 2.0F, 2.0F, kNan, 7.0F}), row({1.0F, 2.5F, kNone, 1.0F, 7.5F}), 5.0, residuals);
  add_residuals(row({1.0F, 3.0F}), row({0.75F, 3.125F}), 5.0, residuals);
  EXPECT_EQ(residuals.measured, 4U);
  EXPECT_DOUBLE_EQ(residuals.covered(), 0.75);
  EXPECT_DOUBLE_EQ(residuals.median_m(), 0.25);
}

TEST(DepthResidualsTest, NothingMeasuredSaysNothing) {
  const DepthResiduals none;
  EXPECT_TRUE(std::isnan(none.median_m()));
  EXPECT_TRUE(std::isnan(none.covered()));
}

}  // namespace
}  // namespace semview::evaluation
