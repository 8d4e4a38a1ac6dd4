// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/weight_learner.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace semview::similarity {
namespace {

const ClassTable kObserved({"wall", "table"});
const ClassTable kMap({"wall", "desk"});
constexpr PanoramaCamera kCamera{.columns = 120, .rows = 2};

/// Columns 0..59 of both rows show the wall, 60..119 the desk.
LabelImage halves(ClassId left, ClassId right) {
  LabelImage labels(2, 120, left);
  for (int row = 0; row < 2; ++row) {
    for (int column = 60; column < 120; ++column) labels.at(row, column) = right;
  }
  return labels;
}

std::size_t index(std::span<const std::string> names, std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

double weight(const WeightMatrix& matrix,
              std::size_t band,
              std::string_view i,
              std::string_view j) {
  return matrix.weight(band, index(matrix.observed_names(), i), index(matrix.map_names(), j));
}

TEST(WeightLearnerTest, AWeightIsTheLogarithmOfHowMuchLikelierTheNameIsThere) {
  WeightLearner learner({.bands = 1, .prior_pixels = 1e-9}, kObserved, kMap, kCamera);
  LabelImage observed = halves(1, 2);
  for (int column = 0; column < 15; ++column) observed.at(0, column) = 2;  // one of eight is wrong
  learner.add(observed, halves(1, 2));
  const auto matrix = learner.matrix();
  ASSERT_TRUE(matrix) << matrix.error().message;
  // 240 pixels: wall named so 105 of 120 times, and 105 of 240 in all.
  EXPECT_NEAR(
      weight(*matrix, 0, "wall", "wall"), std::log((105.0 / 120.0) / (105.0 / 240.0)), 1e-6);
  EXPECT_NEAR(
      weight(*matrix, 0, "table", "wall"), std::log((15.0 / 120.0) / (135.0 / 240.0)), 1e-6);
  EXPECT_NEAR(weight(*matrix, 0, "table", "desk"), std::log(1.0 / (135.0 / 240.0)), 1e-6);
}

TEST(WeightLearnerTest, WhatNeverMetIsUnlikelyAndNotImpossible) {
  WeightLearner learner({.bands = 1, .largest_weight = 3.0}, kObserved, kMap, kCamera);
  for (int i = 0; i < 1000; ++i) learner.add(halves(1, 2), halves(1, 2));
  const auto matrix = learner.matrix();
  ASSERT_TRUE(matrix);
  EXPECT_EQ(weight(*matrix, 0, "wall", "desk"), -3.0);
}

TEST(WeightLearnerTest, AClassThatNobodySawSaysNothing) {
  WeightLearner learner({.bands = 1}, kObserved, kMap, kCamera);
  learner.add(halves(1, 1), halves(1, kNoHit));
  const auto matrix = learner.matrix();
  ASSERT_TRUE(matrix);
  EXPECT_EQ(weight(*matrix, 0, "wall", "desk"), 0.0) << "the map never showed one";
  EXPECT_EQ(weight(*matrix, 0, "table", "wall"), 0.0) << "the network never named one";
  EXPECT_NEAR(weight(*matrix, 0, "wall", "none"), 0.0, 1e-12) << "all walls: no news";
}

TEST(WeightLearnerTest, BandsRiseFromTheLowestRowAndCoverAllElevations) {
  WeightLearner learner({.bands = 2, .prior_pixels = 1e-9}, kObserved, kMap, kCamera);
  LabelImage observed = halves(1, 2);
  for (int column = 0; column < 60; ++column) observed.at(1, column) = 2;  // wrong below only
  learner.add(observed, halves(1, 2));
  const auto matrix = learner.matrix();
  ASSERT_TRUE(matrix);
  ASSERT_EQ(matrix->bands().size(), 2U);
  EXPECT_EQ(matrix->bands()[0].elevation_min_deg, -90.0);
  EXPECT_EQ(matrix->bands()[0].elevation_max_deg, matrix->bands()[1].elevation_min_deg);
  EXPECT_EQ(matrix->bands()[1].elevation_max_deg, 90.0);
  EXPECT_NEAR(weight(*matrix, 1, "wall", "wall"), std::log(2.0), 1e-6);
  EXPECT_NEAR(weight(*matrix, 0, "table", "wall"), 0.0, 1e-6) << "below all is called table";
}

TEST(WeightLearnerTest, UnknownPixelsTeachNothing) {
  WeightLearner learner({.bands = 1}, kObserved, kMap, kCamera);
  learner.add(LabelImage(2, 120, kUnknown), halves(1, 2));
  EXPECT_EQ(learner.pixels(), 0);
  EXPECT_EQ(learner.matrix().error().code, ErrorCode::kFailedPrecondition);
}

}  // namespace
}  // namespace semview::similarity
