// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "semview/geometry/affine.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/geometry/pinhole_camera.hpp"

namespace semview {
namespace {

TEST(PanoramaCameraTest, TheHeadingIsInTheMiddleAndLeftIsOnTheLeft) {
  const PanoramaCamera camera;
  // The two columns beside the middle look half a column to the left and right of the heading.
  EXPECT_NEAR(camera.azimuth_rad(179), rad_from_deg(0.5), 1e-15);
  EXPECT_NEAR(camera.azimuth_rad(180), rad_from_deg(-0.5), 1e-15);
  EXPECT_GT(camera.direction(45, 90).y(), 0.99);
  EXPECT_LT(camera.direction(45, 270).y(), -0.99);
  EXPECT_LT(camera.direction(45, 0).x(), -0.99);
}

TEST(PanoramaCameraTest, TheFirstRowLooksHighest) {
  const PanoramaCamera camera;
  EXPECT_DOUBLE_EQ(camera.elevation_rad(0), rad_from_deg(44.5));
  EXPECT_DOUBLE_EQ(camera.elevation_rad(89), rad_from_deg(-44.5));
  EXPECT_NEAR(camera.direction(0, 7).z(), std::sin(rad_from_deg(44.5)), 1e-15);
}

TEST(PanoramaCameraTest, EveryPixelCentreFallsIntoItsOwnPixel) {
  for (const PanoramaCamera& camera : {PanoramaCamera{},
                                       PanoramaCamera{720, 33, -0.3, 1.1},
                                       PanoramaCamera{120, 1, -kPi / 2.0, kPi / 2.0}}) {
    for (int c = 0; c < camera.columns; ++c) EXPECT_EQ(camera.column_of(camera.azimuth_rad(c)), c);
    for (int r = 0; r < camera.rows; ++r) EXPECT_EQ(camera.row_of(camera.elevation_rad(r)), r);
  }
}

TEST(PanoramaCameraTest, AnglesWrapAndElevationsOutsideHaveNoRow) {
  const PanoramaCamera camera;
  EXPECT_EQ(camera.column_of(0.3), camera.column_of(0.3 + kTwoPi));
  EXPECT_EQ(camera.column_of(kPi), 0);
  EXPECT_EQ(camera.column_of(-kPi), 0);
  EXPECT_EQ(camera.row_of(rad_from_deg(45.1)), -1);
  EXPECT_EQ(camera.row_of(rad_from_deg(-45.1)), -1);
}

TEST(PinholeCameraTest, RaysGoThroughPixelCentres) {
  const PinholeCamera camera{4, 2, 10.0, 20.0, 2.0, 1.0};
  const Eigen::Vector3d corner = camera.direction(0, 0);
  EXPECT_DOUBLE_EQ(corner.x(), -0.15);
  EXPECT_DOUBLE_EQ(corner.y(), -0.025);
  EXPECT_DOUBLE_EQ(corner.z(), 1.0);
}

TEST(LevelCameraTest, LooksAlongTheHeadingWithDownBelow) {
  const Eigen::Isometry3d map_from_camera = level_camera({1.0, 2.0, kPi / 2.0}, 1.2);
  const Eigen::Vector3d ahead = map_from_camera * Eigen::Vector3d(0.0, 0.0, 3.0);
  EXPECT_TRUE(ahead.isApprox(Eigen::Vector3d(1.0, 5.0, 1.2), 1e-12));
  const Eigen::Vector3d right = map_from_camera * Eigen::Vector3d(1.0, 0.0, 0.0);
  EXPECT_TRUE(right.isApprox(Eigen::Vector3d(2.0, 2.0, 1.2), 1e-12));
  const Eigen::Vector3d down = map_from_camera * Eigen::Vector3d(0.0, 1.0, 0.0);
  EXPECT_TRUE(down.isApprox(Eigen::Vector3d(1.0, 2.0, 0.2), 1e-12));
  EXPECT_NEAR(map_from_camera.linear().determinant(), 1.0, 1e-12);
}

TEST(MapAffineTest, ScalesAndShearsDirectionsWithoutNormalising) {
  const MapAffine affine{2.0, 3.0, 0.5};
  EXPECT_EQ(affine.apply({1.0, 0.0, 0.25}), Eigen::Vector3d(2.0, 0.5, 0.25));
  EXPECT_EQ(affine.apply({0.0, 1.0, 0.0}), Eigen::Vector3d(0.0, 3.0, 0.0));
  EXPECT_EQ(MapAffine{}.apply({0.6, 0.8, -1.0}), Eigen::Vector3d(0.6, 0.8, -1.0));
}

}  // namespace
}  // namespace semview
