// SPDX-License-Identifier: Apache-2.0
#include "semview/places/place_refinement.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "semview/geometry/angle.hpp"

namespace semview::places {
namespace {

const PanoramaCamera kCamera{360, 60, -kPi / 3.0, kPi / 3.0};
constexpr double kLeft_m = -2.0;
constexpr double kRight_m = 3.0;
constexpr double kBottom_m = -1.5;
constexpr double kTop_m = 2.5;

/// An empty room with a window in the right wall's middle third, floor 1, wall 2, window 3, as seen
/// at yaw `yaw_rad`.
std::optional<LabelImage> room(double x_m, double y_m, double eye_height_m, double yaw_rad = 0.0) {
  if (x_m <= kLeft_m || x_m >= kRight_m || y_m <= kBottom_m || y_m >= kTop_m) return {};
  LabelImage labels(kCamera.rows, kCamera.columns, 2);
  for (int c = 0; c < kCamera.columns; ++c) {
    const double azimuth_rad = kCamera.azimuth_rad(c) + yaw_rad;
    const double dx = std::cos(azimuth_rad);
    const double dy = std::sin(azimuth_rad);
    const double to_x = dx > 0.0 ? (kRight_m - x_m) / dx : (kLeft_m - x_m) / dx;
    const double to_y = dy > 0.0 ? (kTop_m - y_m) / dy : (kBottom_m - y_m) / dy;
    const double range_m = std::min(to_x, to_y);
    const double hit_y_m = y_m + range_m * dy;
    const bool window = dx > 0.0 && to_x < to_y && hit_y_m > -0.2 && hit_y_m < 1.1;
    for (int r = 0; r < kCamera.rows; ++r) {
      const double z_m = eye_height_m + range_m * std::tan(kCamera.elevation_rad(r));
      if (z_m < 0.0) labels.at(r, c) = 1;
      if (z_m > 2.5) labels.at(r, c) = 4;
      if (window && z_m > 0.9 && z_m < 2.0) labels.at(r, c) = 3;
    }
  }
  return labels;
}

ColumnScorer scorer_of(const LabelImage& observed) {
  const ClassTable classes({"floor", "wall", "window", "ceiling"});
  return ColumnScorer::build(
             {classes, observed}, similarity::WeightMatrix::identity(classes), classes, kCamera, {})
      .value();
}

const ExactView kRoom = [](double x_m, double y_m, double z_m) { return room(x_m, y_m, z_m); };

TEST(PlaceRefinementTest, EndsWithinTwoCentimetresAndHalfADegree) {
  const Pose2 truth{0.413, 0.287, rad_from_deg(41.3)};
  const ColumnScorer scorer = scorer_of(*room(truth.x_m, truth.y_m, 1.3, truth.yaw_rad));
  const EyePlacement start{{0.55, 0.15, rad_from_deg(39.0)}, 1.3, 0.0};
  const EyePlacement end = refine(start, scorer, kRoom, {});
  EXPECT_NEAR(end.map_from_eye.x_m, truth.x_m, 0.02);
  EXPECT_NEAR(end.map_from_eye.y_m, truth.y_m, 0.02);
  EXPECT_NEAR(deg_from_rad(wrap_angle(end.map_from_eye.yaw_rad - truth.yaw_rad)), 0.0, 0.5);
  EXPECT_EQ(end.eye_height_m, 1.3);
}

TEST(PlaceRefinementTest, FindsTheEyeHeightWhereItMay) {
  const ColumnScorer scorer = scorer_of(*room(0.2, 0.3, 1.42));
  const EyePlacement start{{0.25, 0.25, 0.0}, 1.3, 0.0};
  RefinementConfig config;
  config.finds_eye_height = true;
  EXPECT_NEAR(refine(start, scorer, kRoom, config).eye_height_m, 1.42, 0.04);
  config.height_reach_m = 0.05;
  EXPECT_LE(refine(start, scorer, kRoom, config).eye_height_m, 1.35 + 1e-9);
}

TEST(PlaceRefinementTest, AStartWithoutAViewScoresNothing) {
  const ColumnScorer scorer = scorer_of(*room(0.2, 0.3, 1.3));
  const ExactView nowhere = [](double, double, double) { return std::nullopt; };
  const EyePlacement end = refine({{9.0, 9.0, 0.0}, 1.3, 0.0}, scorer, nowhere, {});
  EXPECT_FALSE(std::isfinite(end.score));
}

}  // namespace
}  // namespace semview::places
