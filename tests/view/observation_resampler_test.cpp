// SPDX-License-Identifier: Apache-2.0
#include "semview/view/observation_resampler.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "semview/core/random.hpp"

namespace semview {
namespace {

const PanoramaCamera kProfile{120, 30, rad_from_deg(-45.0), rad_from_deg(45.0)};

PartialPanorama full_turn(int columns, int rows) {
  PartialPanorama camera;
  camera.columns = columns;
  camera.rows = rows;
  return camera;
}

LabelImage random_labels(int rows, int columns) {
  LabelImage labels(rows, columns);
  Rng rng(11, "labels");
  for (ClassId& label : labels.pixels()) label = static_cast<ClassId>(1 + rng.below(200));
  return labels;
}

TEST(ObservationResamplerTest, TheProfilesOwnShapeIsLeftAsItIs) {
  const LabelImage labels = random_labels(30, 120);
  EXPECT_EQ(resample(labels, full_turn(120, 30), kProfile), labels);
}

TEST(ObservationResamplerTest, AFinerImageGivesTheMajority) {
  LabelImage labels(90, 360, 1);
  // Of the 3 × 3 pixels under profile pixel (2, 5), five say 4; under (0, 0) all say "nothing".
  for (const auto& [r, c] : {std::pair{6, 15}, {6, 16}, {7, 15}, {8, 17}, {8, 16}}) {
    labels.at(r, c) = 4;
  }
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) labels.at(r, c) = kNoHit;
  }
  LabelImage expected(30, 120, 1);
  expected.at(2, 5) = 4;
  expected.at(0, 0) = kUnknown;
  EXPECT_EQ(resample(labels, full_turn(360, 90), kProfile), expected);
}

TEST(ObservationResamplerTest, EqualVotesGoToTheLowerId) {
  LabelImage labels(30, 240, 9);
  labels.at(4, 11) = 2;  // beside a 9 under profile pixel (4, 5)
  const LabelImage resampled = resample(labels, full_turn(240, 30), kProfile);
  EXPECT_EQ(resampled.at(4, 5), 2);
  EXPECT_EQ(resampled.at(4, 4), 9);
}

TEST(ObservationResamplerTest, ACoarserImageIsEnlarged) {
  const LabelImage labels = random_labels(10, 40);
  const LabelImage resampled = resample(labels, full_turn(40, 10), kProfile);
  for (int r = 0; r < 30; ++r) {
    for (int c = 0; c < 120; ++c) EXPECT_EQ(resampled.at(r, c), labels.at(r / 3, c / 3));
  }
}

TEST(ObservationResamplerTest, WhatAPartialPanoramaDoesNotShowIsUnknown) {
  PartialPanorama camera;
  camera.columns = 30;
  camera.rows = 10;
  camera.azimuth_left_rad = rad_from_deg(30.0);
  camera.azimuth_right_rad = rad_from_deg(-60.0);
  camera.elevation_min_rad = rad_from_deg(-15.0);
  camera.elevation_max_rad = rad_from_deg(15.0);
  const LabelImage resampled = resample(LabelImage(10, 30, 6), camera, kProfile);
  for (int r = 0; r < kProfile.rows; ++r) {
    for (int c = 0; c < kProfile.columns; ++c) {
      const double azimuth_deg = deg_from_rad(kProfile.azimuth_rad(c));
      const double elevation_deg = deg_from_rad(kProfile.elevation_rad(r));
      const bool seen = azimuth_deg < 30.0 && azimuth_deg > -60.0 && std::abs(elevation_deg) < 15.0;
      EXPECT_EQ(resampled.at(r, c), seen ? 6 : kUnknown) << azimuth_deg << ' ' << elevation_deg;
    }
  }
}

TEST(ObservationResamplerTest, ARangeAcrossTheBackIsUnderstood) {
  PartialPanorama camera = full_turn(60, 30);
  camera.azimuth_left_rad = rad_from_deg(270.0);
  camera.azimuth_right_rad = rad_from_deg(90.0);
  const LabelImage resampled = resample(LabelImage(30, 60, 6), camera, kProfile);
  EXPECT_EQ(resampled.at(15, 0), 6);    // behind
  EXPECT_EQ(resampled.at(15, 119), 6);  // behind, other side
  EXPECT_EQ(resampled.at(15, 60), kUnknown);
  EXPECT_EQ(resampled.at(15, 29), 6);  // 91.5° to the left
  EXPECT_EQ(resampled.at(15, 30), kUnknown);
}

/// A level camera at the robot's centre, turned by `yaw_rad`.
MountedPinhole pinhole(double yaw_rad, int columns, int rows, double focal_px) {
  MountedPinhole mounted;
  mounted.camera = {columns, rows, focal_px, focal_px, columns / 2.0, rows / 2.0};
  mounted.base_from_camera = level_camera({0.2, -0.1, yaw_rad}, 1.2);
  return mounted;
}

TEST(ObservationResamplerTest, APinholeLooksWhereItIsMounted) {
  // 90° wide, facing left; the picture's left half is 3, its right half 5.
  LabelImage labels(200, 200, 5);
  for (int r = 0; r < 200; ++r) {
    for (int c = 0; c < 100; ++c) labels.at(r, c) = 3;
  }
  const MountedPinhole camera = pinhole(kPi / 2.0, 200, 200, 100.0);
  const LabelImage resampled = resample(labels, camera, kProfile);
  for (int c = 0; c < kProfile.columns; ++c) {
    const double from_axis_deg = deg_from_rad(kProfile.azimuth_rad(c)) - 90.0;
    const ClassId expected =
        std::abs(from_axis_deg) > 45.0 ? kUnknown : (from_axis_deg > 0.0 ? 3 : 5);
    EXPECT_EQ(resampled.at(15, c), expected) << from_axis_deg;
  }
}

TEST(ObservationResamplerTest, ACoarsePinholeFillsEveryPixelThatItSees) {
  const MountedPinhole camera = pinhole(0.0, 8, 6, 5.0);
  const LabelImage resampled = resample(LabelImage(6, 8, 2), camera, kProfile);
  for (int r = 0; r < kProfile.rows; ++r) {
    for (int c = 0; c < kProfile.columns; ++c) {
      const Eigen::Vector3d d = kProfile.direction(r, c);
      const bool inside = d.x() > 0.0 && std::abs(d.y() / d.x()) < 0.8 - 1e-9 &&
                          std::abs(d.z() / d.x()) < 0.6 - 1e-9;
      if (inside) {
        EXPECT_EQ(resampled.at(r, c), 2) << r << ' ' << c;
      }
    }
  }
  EXPECT_EQ(resampled.at(15, 0), kUnknown);
}

TEST(ObservationResamplerTest, TheEyeStandsWhereTheCameraIsMounted) {
  const Pose2 eye = base_from_eye(pinhole(1.0, 8, 6, 5.0));
  EXPECT_DOUBLE_EQ(eye.x_m, 0.2);
  EXPECT_DOUBLE_EQ(eye.y_m, -0.1);
  EXPECT_EQ(eye.yaw_rad, 0.0);
}

std::string wrong_field(const ObservationCamera& camera) {
  const Status status = validate(camera);
  return status ? "" : status.error().field;
}

TEST(ObservationCameraTest, EachFaultNamesItsField) {
  EXPECT_EQ(wrong_field(full_turn(360, 90)), "");
  EXPECT_EQ(wrong_field(full_turn(0, 90)), "size");
  PartialPanorama panorama = full_turn(360, 90);
  panorama.azimuth_right_rad = -4.0;
  EXPECT_EQ(wrong_field(panorama), "azimuth");
  panorama = full_turn(360, 90);
  panorama.elevation_max_rad = 2.0;
  EXPECT_EQ(wrong_field(panorama), "elevation");
  MountedPinhole mounted = pinhole(0.0, 8, 6, 5.0);
  EXPECT_EQ(wrong_field(mounted), "");
  mounted.camera.fx_px = 0.0;
  EXPECT_EQ(wrong_field(mounted), "intrinsics");
  mounted = pinhole(0.0, 8, 6, 5.0);
  mounted.base_from_camera.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(wrong_field(mounted), "base_from_camera");
}

}  // namespace
}  // namespace semview
