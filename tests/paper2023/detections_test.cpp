// SPDX-License-Identifier: Apache-2.0
#include "experiments/paper2023/detections.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "experiments/paper2023/things.hpp"

namespace semview::paper2023 {
namespace {

constexpr auto kTable = static_cast<ClassId>(ThingClass::kTable);

/// One pixel an object, of class table, then one of a wall.
RgbdTruth row_of_objects(int count) {
  RgbdTruth truth;
  truth.labels = LabelImage(1, count + 1, kTable);
  truth.objects = Image<std::int32_t>(1, count + 1);
  for (int i = 0; i < count; ++i) truth.objects.at(0, i) = i + 1;
  truth.labels.at(0, count) = kNoHit;
  truth.objects.at(0, count) = 0;
  return truth;
}

DetectorConfig exact_borders() {
  DetectorConfig config;
  config.border_at_640_px = 0.0;
  return config;
}

TEST(DetectionsTest, WallsHaveNoName) {
  const RgbdTruth truth = row_of_objects(2);
  EXPECT_EQ(true_labels(truth).at(0, 0), kTable);
  EXPECT_EQ(true_labels(truth).at(0, 2), kUnknown);
  EXPECT_EQ(detect(truth, {0.0, 0.0, 0.0}, 1, 2), true_labels(truth));
}

TEST(DetectionsTest, MissesAndMistakesHaveTheirShares) {
  constexpr int kObjects = 20'000;
  const RgbdTruth truth = row_of_objects(kObjects);
  const DetectorConfig config = exact_borders();
  const LabelImage named = detect(truth, config, 1, 2);
  double missed = 0.0;
  double mistaken = 0.0;
  for (int i = 0; i < kObjects; ++i) {
    const ClassId label = named.at(0, i);
    if (label == kUnknown) {
      missed += 1.0;
    } else if (label != kTable) {
      mistaken += 1.0;
    }
  }
  // Four standard errors.
  EXPECT_NEAR(missed / kObjects, 0.15, 4.0 * std::sqrt(0.15 * 0.85 / kObjects));
  EXPECT_NEAR(mistaken / (kObjects - missed), 0.08, 4.0 * std::sqrt(0.08 * 0.92 / kObjects));
  EXPECT_EQ(named.at(0, kObjects), kUnknown);
}

TEST(DetectionsTest, HalfOfTheMissesComeBackInEveryView) {
  constexpr int kObjects = 20'000;
  const RgbdTruth truth = row_of_objects(kObjects);
  const LabelImage one = detect(truth, exact_borders(), 1, 2);
  const LabelImage other = detect(truth, exact_borders(), 1, 3);
  const LabelImage elsewhere = detect(truth, exact_borders(), 4, 5);
  double both = 0.0;
  double apart = 0.0;
  for (int i = 0; i < kObjects; ++i) {
    if (one.at(0, i) != kUnknown) continue;
    both += other.at(0, i) == kUnknown ? 1.0 : 0.0;
    apart += elsewhere.at(0, i) == kUnknown ? 1.0 : 0.0;
  }
  const double half = 1.0 - std::sqrt(0.85);
  const double always_and_twice = half + (1.0 - half) * half * half;
  EXPECT_NEAR(both / kObjects, always_and_twice, 4.0 * std::sqrt(0.085 / kObjects));
  EXPECT_NEAR(apart / kObjects, 0.15 * 0.15, 4.0 * std::sqrt(0.0225 / kObjects));
}

TEST(DetectionsTest, BordersAreOffByAPixelOfAQuarterImage) {
  RgbdTruth truth;
  truth.labels = LabelImage(120, 160, kNoHit);
  truth.objects = Image<std::int32_t>(120, 160, 0);
  for (int row = 0; row < 120; ++row) {
    for (int column = 80; column < 160; ++column) {
      truth.labels.at(row, column) = kTable;
      truth.objects.at(row, column) = 1;
    }
  }
  double squares = 0.0;
  double rows = 0.0;
  for (std::uint64_t view = 0; view < 40; ++view) {
    const LabelImage named = detect(truth, {0.0, 0.0, 4.0, 40.0}, 1, view);
    for (int row = 0; row < 120; row += 20) {
      double width = 0.0;
      for (int column = 60; column < 100; ++column) width += named.at(row, column) == kTable;
      squares += (width - 20.0) * (width - 20.0);
      rows += 1.0;
    }
  }
  // Bilinear between nodes has less than their σ of one pixel; rounding adds 1/12.
  EXPECT_GT(std::sqrt(squares / rows), 0.5);
  EXPECT_LT(std::sqrt(squares / rows), 1.3);
}

}  // namespace
}  // namespace semview::paper2023
