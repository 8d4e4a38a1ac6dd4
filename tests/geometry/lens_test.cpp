// SPDX-License-Identifier: Apache-2.0
#include "semview/geometry/lens.hpp"

#include <cmath>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/core/random.hpp"
#include "semview/geometry/angle.hpp"

namespace semview {
namespace {

using ::testing::HasSubstr;

/// Directions up to `half_angle_deg` off the axis.
Eigen::Vector3d random_direction(Rng& rng, double half_angle_deg) {
  const double off_rad = rad_from_deg(half_angle_deg) * std::sqrt(rng.uniform());
  const double around_rad = rng.uniform(-kPi, kPi);
  return {std::sin(off_rad) * std::cos(around_rad),
          std::sin(off_rad) * std::sin(around_rad),
          std::cos(off_rad)};
}

/// The distortion model as OpenCV's manual prints it, term by term.
Eigen::Vector2d printed_plumb_bob(const Eigen::Vector3d& d, const Lens::Coefficients& k) {
  const auto [k1, k2, p1, p2, k3] = k;
  const double x = d.x() / d.z();
  const double y = d.y() / d.z();
  const double r = std::sqrt(x * x + y * y);
  const double radial = 1 + k1 * std::pow(r, 2) + k2 * std::pow(r, 4) + k3 * std::pow(r, 6);
  return {x * radial + 2 * p1 * x * y + p2 * (r * r + 2 * x * x),
          y * radial + p1 * (r * r + 2 * y * y) + 2 * p2 * x * y};
}

Eigen::Vector2d printed_equidistant(const Eigen::Vector3d& d, const Lens::Coefficients& k) {
  const double a = d.x() / d.z();
  const double b = d.y() / d.z();
  const double r = std::hypot(a, b);
  const double t = std::atan(r);
  const double td = t * (1 + k[0] * std::pow(t, 2) + k[1] * std::pow(t, 4) + k[2] * std::pow(t, 6) +
                         k[3] * std::pow(t, 8));
  return {td / r * a, td / r * b};
}

const Lens::Coefficients kBarrel{-0.31, 0.12, 0.0012, -0.0008, -0.02};
const Lens::Coefficients kFisheye{-0.02, 0.006, -0.004, 0.0007};

TEST(LensTest, PlumbBobIsTheFormulaOfTheManual) {
  const Lens lens = *Lens::make(Lens::Model::kPlumbBob, kBarrel);
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d d = random_direction(rng, 38.0);
    const auto point = lens.project(3.0 * d);
    ASSERT_TRUE(point);
    EXPECT_LT((*point - printed_plumb_bob(d, kBarrel)).norm(), 1e-12);
  }
}

TEST(LensTest, EquidistantIsTheFormulaOfTheManual) {
  const Lens lens = *Lens::make(Lens::Model::kEquidistant, kFisheye);
  Rng rng(2);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d d = random_direction(rng, 85.0);
    const auto point = lens.project(d);
    ASSERT_TRUE(point);
    EXPECT_LT((*point - printed_equidistant(d, kFisheye)).norm(), 1e-12);
  }
}

TEST(LensTest, WhatIsSeenAtAPointIsSeenThere) {
  Rng rng(3);
  const Lens barrel = *Lens::make(Lens::Model::kPlumbBob, kBarrel);
  const Lens fisheye = *Lens::make(Lens::Model::kEquidistant, kFisheye);
  const std::vector<std::pair<Lens, double>> lenses{
      {Lens(), 80.0}, {barrel, 38.0}, {fisheye, 105.0}};
  for (const auto& [lens, half_angle_deg] : lenses) {
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d d = random_direction(rng, half_angle_deg);
      const auto point = lens.project(d);
      ASSERT_TRUE(point);
      const auto back = lens.unproject(*point);
      ASSERT_TRUE(back);
      EXPECT_LT((*back - d).norm(), 1e-8);
    }
  }
}

TEST(LensTest, NoDirectionIsSeenTwice) {
  // Barrel distortion alone turns back at r² = 1/(3·0.31): 46° off the axis.
  const Lens lens = *Lens::make(Lens::Model::kPlumbBob, {-0.31});
  const double turn = std::atan(std::sqrt(1.0 / (3.0 * 0.31)));
  EXPECT_TRUE(lens.project({std::sin(turn - 0.02), 0.0, std::cos(turn - 0.02)}));
  EXPECT_FALSE(lens.project({std::sin(turn + 0.02), 0.0, std::cos(turn + 0.02)}));
  EXPECT_FALSE(lens.unproject({0.9, 0.0}));
}

TEST(LensTest, NothingIsSeenBehindAPinholeButByAFisheye) {
  EXPECT_FALSE(Lens().project({0.1, 0.0, -1.0}));
  EXPECT_FALSE(Lens().project({1.0, 0.0, 0.0}));
  EXPECT_FALSE(Lens::make(Lens::Model::kPlumbBob, {})->project({0.1, 0.0, -1.0}));
  const Lens fisheye = *Lens::make(Lens::Model::kEquidistant, {});
  EXPECT_NEAR(fisheye.project({1.0, 0.0, 0.0})->x(), kPi / 2.0, 1e-12);
  EXPECT_NEAR(fisheye.project({1.0, 0.0, -1.0})->x(), 0.75 * kPi, 1e-12);
}

TEST(LensTest, WildCoefficientsAreRefused) {
  const auto lens = Lens::make(Lens::Model::kPlumbBob, {0.0, std::nan("")});
  ASSERT_FALSE(lens);
  EXPECT_THAT(lens.error().message, HasSubstr("distortion coefficient nan"));
  EXPECT_FALSE(Lens::make(Lens::Model::kEquidistant, {2000.0}));
  EXPECT_TRUE(Lens::make(Lens::Model::kNone, {2000.0}));
}

}  // namespace
}  // namespace semview
