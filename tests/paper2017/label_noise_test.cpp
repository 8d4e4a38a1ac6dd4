// SPDX-License-Identifier: Apache-2.0
#include "experiments/paper2017/label_noise.hpp"

#include <gtest/gtest.h>

#include "experiments/paper2017/label_errors.hpp"
#include "semview/geometry/angle.hpp"

namespace semview::paper2017 {
namespace {

constexpr double kPixel_rad = 0.0174533;

LabelNoiseConfig none() {
  LabelNoiseConfig config;
  config.object_error = config.patch_share = config.border_shift_rad = config.salt_share = 0.0;
  config.level = 1.0;
  return config;
}

/// Walls above, floor below, and `objects` tables in a row between them.
SceneView room(int objects) {
  SceneView view{LabelImage(60, 240, static_cast<ClassId>(RawClass::kWall)),
                 Image<std::int32_t>(60, 240, 0),
                 Image<float>(60, 240, 1.0F)};
  for (int row = 30; row < 60; ++row) {
    for (int column = 0; column < 240; ++column) {
      view.labels.at(row, column) = static_cast<ClassId>(RawClass::kFloor);
    }
  }
  for (int column = 0; column < objects; ++column) {
    view.labels.at(30, column) = static_cast<ClassId>(RawClass::kTable);
    view.objects.at(30, column) = column + 1;
  }
  return view;
}

double wrong_share(const SceneView& view, const LabelImage& labels) {
  LabelErrors errors;
  errors.add(view.labels, labels);
  return 1.0 - errors.pixel_accuracy();
}

TEST(LabelNoiseTest, LevelZeroMakesNoError) {
  LabelNoiseConfig config;
  config.level = 0.0;
  EXPECT_EQ(misread(room(20), kPixel_rad, config, 1, 2), room(20).labels);
}

TEST(LabelNoiseTest, PatchesTakeTheirShareOfWallsAndFloor) {
  LabelNoiseConfig config = none();
  config.patch_share = 0.09;
  const SceneView view = room(0);
  EXPECT_NEAR(wrong_share(view, misread(view, kPixel_rad, config, 1, 2)), 0.09, 0.005);
}

TEST(LabelNoiseTest, SaltTakesItsShareLessWhatItHitsRight) {
  LabelNoiseConfig config = none();
  config.salt_share = 0.10;
  const SceneView view = room(0);
  // 14 400 pixels: σ = 0.0025; one name of 22 is the right one.
  EXPECT_NEAR(wrong_share(view, misread(view, kPixel_rad, config, 1, 2)),
              0.10 * (1.0 - 1.0 / kRawClassCount),
              0.01);
}

TEST(LabelNoiseTest, HalfOfTheMistakenObjectsAreMistakenInEveryView) {
  LabelNoiseConfig config = none();
  config.object_error = 0.5;
  const SceneView view = room(240);
  int always = 0;
  int once = 0;
  const LabelImage first = misread(view, kPixel_rad, config, 1, 2);
  const LabelImage second = misread(view, kPixel_rad, config, 1, 3);
  for (int column = 0; column < 240; ++column) {
    const auto wrong = [&](const LabelImage& labels) {
      return labels.at(30, column) != view.labels.at(30, column);
    };
    if (wrong(first) && wrong(second)) ++always;
    if (wrong(first)) ++once;
  }
  // Always: a quarter, and a sixteenth of the others by chance in both; once: a quarter and
  // another quarter of three quarters. σ of 240 objects: 0.03.
  EXPECT_NEAR(once / 240.0, 0.25 + 0.75 * 0.25, 0.10);
  EXPECT_NEAR(always / 240.0, 0.25 + 0.75 * 0.0625, 0.09);
}

TEST(LabelNoiseTest, BordersMoveByTheirSigma) {
  LabelNoiseConfig config = none();
  config.border_shift_rad = 3.0 * kPixel_rad;
  const SceneView view = room(0);
  const LabelImage labels = misread(view, kPixel_rad, config, 1, 2);
  double squares = 0.0;
  for (int column = 0; column < 240; ++column) {
    int border = 0;
    while (border < 60 && labels.at(border, column) == view.labels.at(0, 0)) ++border;
    squares += (border - 30) * (border - 30) / 240.0;
  }
  // Bilinear between nodes: the values in between have a smaller σ than those at the nodes.
  EXPECT_GT(std::sqrt(squares), 1.0);
  EXPECT_LT(std::sqrt(squares), 4.5);
}

TEST(LabelErrorsTest, AccuracyAndIouAreThoseOfTheCounts) {
  LabelErrors errors;
  LabelImage truth(1, 4, static_cast<ClassId>(RawClass::kWall));
  truth.at(0, 3) = static_cast<ClassId>(RawClass::kDoor);
  LabelImage named = truth;
  named.at(0, 2) = static_cast<ClassId>(RawClass::kDoor);
  errors.add(truth, named);
  EXPECT_DOUBLE_EQ(errors.pixel_accuracy(), 0.75);
  const int wall = static_cast<int>(RawClass::kWall) - 1;
  const int door = static_cast<int>(RawClass::kDoor) - 1;
  EXPECT_DOUBLE_EQ(errors.iou(wall), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(errors.iou(door), 0.5);
  EXPECT_DOUBLE_EQ(errors.mean_iou(), (2.0 / 3.0 + 0.5) / 2.0);
  EXPECT_TRUE(std::isnan(errors.iou(static_cast<int>(RawClass::kFloor) - 1)));
}

}  // namespace
}  // namespace semview::paper2017
