// SPDX-License-Identifier: Apache-2.0
/// The experiment's depth camera against closed forms.
#include "experiments/paper2023/rgbd_camera.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace semview::paper2023 {
namespace {

using paper2017::Primitive;
using paper2017::Scene;
using paper2017::Shape;

RgbdConfig level() {
  RgbdConfig config;
  config.mount_pitch_rad = 0.0;
  return config;
}

/// A wall across x, its face at `x_m`.
Scene wall_at(double x_m) {
  return Scene({Primitive{Shape::kBox, 5, 7, x_m + 0.5, 0.0, 0.0, 0.5, 50.0, -50.0, 50.0}});
}

RgbdTruth seen(const Scene& scene, const RgbdConfig& config, const Pose2& robot) {
  return look(scene, config, map_from_base(robot) * base_from_camera(config));
}

TEST(RgbdCameraTest, AWallAcrossTheOpticalAxisHasOneDepth) {
  const RgbdTruth truth = seen(wall_at(3.0), level(), {});
  for (const float depth_m : truth.depth_m.pixels()) EXPECT_NEAR(depth_m, 3.0, 1e-6);
  EXPECT_EQ(truth.labels.at(60, 80), 5);
  EXPECT_EQ(truth.objects.at(60, 80), 7);
}

TEST(RgbdCameraTest, APixelsRayMeetsTheGroundWhereGeometrySays) {
  const Scene scene({Primitive{Shape::kBox, kNoHit, 0, 0.0, 0.0, 0.0, 9.0, 9.0, -1.0, 0.0}});
  RgbdConfig config;
  config.mount_pitch_rad = rad_from_deg(12.0);
  const RgbdTruth truth = seen(scene, config, {0.3, -0.2, 1.0});
  const PinholeCamera camera = pinhole(config);
  const int row = 110;
  const double down_rad =
      config.mount_pitch_rad + std::atan((row + 0.5 - camera.cy_px) / camera.fy_px);
  // In the middle column; depth is measured along the axis, the range along the ray.
  const double range_m = config.mount_height_m / std::sin(down_rad);
  const double depth_m = range_m * std::cos(down_rad - config.mount_pitch_rad);
  EXPECT_NEAR(truth.depth_m.at(row, 80), depth_m, 1e-4);
  EXPECT_NEAR(truth.incidence_rad.at(row, 80), kPi / 2.0 - down_rad, 1e-4);
}

TEST(RgbdCameraTest, TheFieldOfViewIsTheConfiguredOne) {
  const RgbdConfig config = level();
  const PinholeCamera camera = pinhole(config);
  EXPECT_NEAR(2.0 * std::atan(camera.cx_px / camera.fx_px), rad_from_deg(58.0), 1e-12);
  EXPECT_NEAR(2.0 * std::atan(camera.cy_px / camera.fy_px), rad_from_deg(45.0), 1e-12);
  // A point ahead and to the left comes to lie in the left half.
  const Scene post({Primitive{Shape::kCylinder, 1, 1, 3.0, 0.8, 0.0, 0.1, 0.1, 0.0, 2.0}});
  const RgbdTruth truth = seen(post, config, {});
  EXPECT_EQ(truth.objects.at(60, 120), -1);
  const int column = static_cast<int>(camera.cx_px - camera.fx_px * 0.8 / 3.0);
  EXPECT_EQ(truth.objects.at(60, column), 1);
}

TEST(RgbdCameraTest, IncidenceIsTheAngleToTheFaceThatIsMet) {
  const Scene scene = wall_at(2.0);
  const RgbdConfig config = level();
  for (const double yaw_rad : {0.2, -0.5}) {
    const RgbdTruth truth = seen(scene, config, {0.0, 0.0, yaw_rad});
    const PinholeCamera camera = pinhole(config);
    const Eigen::Vector3d ray = camera.direction(10, 30).normalized();
    const Eigen::Vector3d along =
        (map_from_base({0.0, 0.0, yaw_rad}) * base_from_camera(config)).linear() * ray;
    EXPECT_NEAR(truth.incidence_rad.at(10, 30), std::acos(along.x()), 1e-5);
  }
  const Scene round({Primitive{Shape::kCylinder, 1, 1, 2.0, 0.0, 0.0, 0.4, 0.4, 0.0, 2.0}});
  const RgbdTruth truth = seen(round, config, {});
  EXPECT_LT(truth.incidence_rad.at(60, 80), 0.02);  // half a pixel from the middle
  EXPECT_NEAR(truth.depth_m.at(60, 80), 1.6, 1e-3);
}

TEST(RgbdCameraTest, NoiseGrowsWithTheSquareOfDepth) {
  const RgbdConfig config = level();
  EXPECT_NEAR(depth_sigma_m(config, 0.4), 0.0012, 1e-12);
  EXPECT_NEAR(depth_sigma_m(config, 3.4), 0.0012 + 0.0019 * 9.0, 1e-12);
  const RgbdTruth truth = seen(wall_at(3.4), config, {});
  Rng rng(1, "test");
  const Image<float> measured = measure(truth, config, rng);
  double sum = 0.0;
  double squares = 0.0;
  for (const float depth_m : measured.pixels()) {
    sum += depth_m - 3.4;
    squares += (depth_m - 3.4) * (depth_m - 3.4);
  }
  const auto count = static_cast<double>(measured.pixels().size());  // 19200
  // Four standard errors: σ/√n of a mean, σ/√2n of a σ.
  EXPECT_NEAR(sum / count, 0.0, 4.0 * 0.0183 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count), 0.0183, 4.0 * 0.0183 / std::sqrt(2.0 * count));
}

TEST(RgbdCameraTest, ObliqueSurfacesDropOut) {
  const RgbdConfig config = level();
  EXPECT_EQ(dropout_share(config, rad_from_deg(74.0)), 0.0);
  EXPECT_NEAR(dropout_share(config, rad_from_deg(80.0)), 0.5, 1e-12);
  EXPECT_EQ(dropout_share(config, rad_from_deg(86.0)), 1.0);
  RgbdTruth truth = seen(wall_at(2.0), config, {});
  for (float& angle_rad : truth.incidence_rad.pixels()) {
    angle_rad = static_cast<float>(rad_from_deg(80.0));
  }
  Rng rng(2, "test");
  const Image<float> measured = measure(truth, config, rng);
  double lost = 0.0;
  for (const float depth_m : measured.pixels()) lost += depth_m == 0.0F ? 1.0 : 0.0;
  const auto count = static_cast<double>(measured.pixels().size());
  EXPECT_NEAR(lost / count, 0.5, 4.0 * 0.5 / std::sqrt(count));
}

TEST(RgbdCameraTest, WhatIsTooNearOrTooFarIsNotMeasured) {
  const RgbdConfig config = level();
  const auto measured = [&](const Scene& scene, const Pose2& robot) {
    Rng rng(3, "test");
    const Image<float> depth_m = measure(seen(scene, config, robot), config, rng);
    return std::ranges::count_if(depth_m.pixels(), [](float value_m) { return value_m != 0.0F; });
  };
  EXPECT_EQ(measured(wall_at(0.35), {}), 0);
  EXPECT_EQ(measured(wall_at(4.8), {}), 0);
  EXPECT_EQ(measured(wall_at(3.0), {0.0, 0.0, kPi}), 0);
  EXPECT_EQ(measured(wall_at(3.0), {}), 160 * 120);
}

}  // namespace
}  // namespace semview::paper2023
