// SPDX-License-Identifier: Apache-2.0
/// The experiment's ray caster against closed forms.
#include "experiments/paper2017/scene.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "semview/geometry/angle.hpp"

namespace semview::paper2017 {
namespace {

constexpr ClassId kTable = 6;

Primitive box(double x_m, double y_m, double yaw_rad, double half_length_m, double half_width_m) {
  Primitive solid;
  solid.label = kTable;
  solid.object = 1;
  solid.x_m = x_m;
  solid.y_m = y_m;
  solid.yaw_rad = yaw_rad;
  solid.half_length_m = half_length_m;
  solid.half_width_m = half_width_m;
  solid.z_min_m = 0.5;
  solid.z_max_m = 1.5;
  return solid;
}

Primitive cylinder(double x_m, double y_m, double radius_m) {
  Primitive solid = box(x_m, y_m, 0.0, radius_m, 0.0);
  solid.shape = Shape::kCylinder;
  return solid;
}

const Eigen::Vector3d kEye{0.0, 0.0, 1.0};

TEST(SceneTest, RayMeetsTheNearFaceOfABox) {
  const Scene scene({box(3.0, 0.0, 0.0, 0.5, 0.2)});
  const SceneHit hit = scene.cast(kEye, {1.0, 0.0, 0.0});
  EXPECT_DOUBLE_EQ(hit.range_m, 2.5);
  EXPECT_EQ(hit.label, kTable);
  EXPECT_EQ(hit.solid, 0U);
  EXPECT_LT(scene.cast(kEye, {-1.0, 0.0, 0.0}).object, 0);
  EXPECT_LT(scene.cast(kEye, {0.0, 1.0, 0.0}).object, 0);
}

TEST(SceneTest, ATurnedBoxIsMetAtItsCorner) {
  // A square of half side 0.5 turned by 45° reaches √2/2 towards the eye.
  const Scene scene({box(3.0, 0.0, kPi / 4.0, 0.5, 0.5)});
  EXPECT_NEAR(scene.cast(kEye, {1.0, 0.0, 0.0}).range_m, 3.0 - std::sqrt(0.5), 1e-12);
}

TEST(SceneTest, ASlantedRayMeetsTheLid) {
  const Scene scene({box(3.0, 0.0, 0.0, 2.0, 2.0)});
  const Eigen::Vector3d above{3.0, 0.0, 2.5};
  EXPECT_DOUBLE_EQ(scene.cast(above, {0.0, 0.0, -1.0}).range_m, 1.0);
  // Down at 45° from 2.5 m: the lid at 1.5 m is √2 away.
  const double half = std::sqrt(0.5);
  EXPECT_NEAR(scene.cast(above, {half, 0.0, -half}).range_m, std::sqrt(2.0), 1e-12);
}

TEST(SceneTest, RayMeetsACylinderWhereTheCircleSays) {
  const Scene scene({cylinder(4.0, 0.3, 0.5)});
  // (4 - t)² + 0.3² = 0.5²
  EXPECT_NEAR(scene.cast(kEye, {1.0, 0.0, 0.0}).range_m, 4.0 - 0.4, 1e-12);
  const Scene beside({cylinder(4.0, 0.51, 0.5)});
  EXPECT_LT(beside.cast(kEye, {1.0, 0.0, 0.0}).object, 0);
}

TEST(SceneTest, AnEyeInsideASolidSeesItsFarSide) {
  const Scene scene({box(0.0, 0.0, 0.0, 1.0, 2.0)});
  EXPECT_DOUBLE_EQ(scene.cast(kEye, {1.0, 0.0, 0.0}).range_m, 1.0);
  EXPECT_DOUBLE_EQ(scene.cast(kEye, {0.0, 1.0, 0.0}).range_m, 2.0);
}

TEST(SceneTest, TheNearestOfManySolidsIsMetWhateverSquareItIsIn) {
  std::vector<Primitive> solids;
  for (int i = 9; i >= 1; --i) {
    solids.push_back(box(0.7 * i + 1.0, 0.05 * i, 0.1 * i, 0.1, 0.4));
    solids.back().object = i;
  }
  const Scene all(solids);
  for (int step = -20; step <= 20; ++step) {
    const double angle_rad = 0.02 * step;
    const Eigen::Vector3d direction{std::cos(angle_rad), std::sin(angle_rad), 0.0};
    SceneHit nearest;
    nearest.range_m = INFINITY;
    for (const Primitive& solid : solids) {
      const SceneHit hit = Scene({solid}).cast(kEye, direction);
      if (hit.object >= 0 && hit.range_m < nearest.range_m) nearest = hit;
    }
    const SceneHit found = all.cast(kEye, direction);
    EXPECT_EQ(found.object, nearest.object) << "at " << angle_rad << " rad";
    if (nearest.object >= 0) {
      EXPECT_DOUBLE_EQ(found.range_m, nearest.range_m);
    }
  }
}

TEST(SceneTest, APanoramaShowsABoxWhereItsAnglesAre) {
  // Front face from (2, -0.5) to (2, 0.5), 0.5 to 1.5 m high, seen from 1 m: azimuths within
  // atan(0.25), elevations within atan(0.5 / 2) straight ahead.
  const Scene scene({box(2.5, 0.0, 0.0, 0.5, 0.5)});
  SceneCamera camera;
  camera.position_m = kEye;
  camera.columns = 360;
  camera.rows = 90;
  camera.width_rad = kTwoPi;
  camera.height_rad = kPi / 2.0;
  const SceneView view = scene.render(camera);
  const double half_width_rad = std::atan(0.25);
  for (int column = 0; column < camera.columns; ++column) {
    const double azimuth_rad = kPi - (column + 0.5) * rad_from_deg(1.0);
    const bool within = std::abs(azimuth_rad) < half_width_rad;
    EXPECT_EQ(view.labels.at(44, column) == kTable, within) << "column " << column;
  }
  for (int row = 0; row < camera.rows; ++row) {
    const double elevation_rad = kPi / 4.0 - (row + 0.5) * rad_from_deg(1.0);
    // Column 180 looks half a degree to the right; the face is 2 / cos of that away.
    const double top_rad = std::atan(0.5 / (2.0 / std::cos(rad_from_deg(0.5))));
    EXPECT_EQ(view.objects.at(row, 180) == 1, std::abs(elevation_rad) < top_rad) << "row " << row;
  }
}

TEST(SceneTest, APitchedCameraLooksDown) {
  const Scene scene({box(2.5, 0.0, 0.0, 0.5, 3.0)});
  SceneCamera camera;
  camera.position_m = {0.0, 0.0, 2.5};
  camera.columns = 1;
  camera.rows = 1;
  camera.width_rad = rad_from_deg(1.0);
  camera.height_rad = rad_from_deg(1.0);
  EXPECT_LT(scene.render(camera).objects.at(0, 0), 0);
  camera.pitch_rad = std::atan2(1.5, 2.2);  // at the front face, 0.2 m below its upper edge
  EXPECT_EQ(scene.render(camera).objects.at(0, 0), 1);
}

TEST(SceneTest, BlockedCountsTheRobotsRadiusAndHeights) {
  const Scene scene({box(2.0, 0.0, 0.0, 0.5, 0.5)});
  EXPECT_TRUE(scene.blocked(1.3, 0.0, 0.21, 0.0, 1.0));
  EXPECT_FALSE(scene.blocked(1.3, 0.0, 0.19, 0.0, 1.0));
  EXPECT_FALSE(scene.blocked(2.0, 0.0, 0.3, 1.6, 2.0));  // above it
  // At the corner the distance counts, not the sides: √2 · 0.2 from it.
  EXPECT_FALSE(scene.blocked(1.3, 0.7, 0.28, 0.0, 1.0));
  EXPECT_TRUE(scene.blocked(1.3, 0.7, 0.29, 0.0, 1.0));
}

}  // namespace
}  // namespace semview::paper2017
