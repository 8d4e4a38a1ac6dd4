// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/plan_likelihood.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace semview::similarity {
namespace {

WeightMatrix matrix() {
  const Vocabulary observed{{"wall"},
                            {"floor"},
                            {"ceiling"},
                            {"windowpane"},
                            {"door"},
                            {"table"},
                            {"sofa"},
                            {"painting"},
                            {"rug"},
                            {"other"}};
  const Vocabulary map{
      {"floor"}, {"wall"}, {"door"}, {"glazing", {"window"}}, {"coffee table"}, {"ceiling"}};
  return plan_likelihood_weights(observed, map).value();
}

double weight(const WeightMatrix& matrix, std::string_view observed, std::string_view map) {
  const auto row = std::ranges::find(matrix.observed_names(), observed);
  const auto column = std::ranges::find(matrix.map_names(), map);
  EXPECT_NE(row, matrix.observed_names().end()) << observed;
  EXPECT_NE(column, matrix.map_names().end()) << map;
  return matrix.weight(0,
                       static_cast<std::size_t>(row - matrix.observed_names().begin()),
                       static_cast<std::size_t>(column - matrix.map_names().begin()));
}

TEST(PlanLikelihoodTest, PartsSpeakForThemselvesAndAgainstOthers) {
  const WeightMatrix weights = matrix();
  for (const auto& [seen, drawn] : {std::pair("wall", "wall"),
                                    std::pair("floor", "floor"),
                                    std::pair("ceiling", "ceiling"),
                                    std::pair("door", "door"),
                                    std::pair("windowpane", "glazing")}) {
    EXPECT_GT(weight(weights, seen, drawn), 0.4) << seen;
    for (const std::string& other : weights.map_names()) {
      if (other == drawn) continue;
      EXPECT_LT(weight(weights, seen, other), weight(weights, seen, drawn)) << seen << other;
    }
  }
  EXPECT_LT(weight(weights, "wall", "floor"), -1.0);
  EXPECT_LT(weight(weights, "floor", "wall"), -1.0);
  EXPECT_LT(weight(weights, "floor", "ceiling"), -1.0);
}

TEST(PlanLikelihoodTest, AnUnseenDoorIsAlmostAWall) {
  const WeightMatrix weights = matrix();
  EXPECT_GT(weight(weights, "wall", "door"), -0.3);
  EXPECT_GT(weight(weights, "door", "door"), 1.0);
}

TEST(PlanLikelihoodTest, UndrawnFurnitureIsNoEvidenceAgainstAFloor) {
  const WeightMatrix weights = matrix();
  for (const char* thing : {"sofa", "other", "table"}) {
    EXPECT_GT(weight(weights, thing, "floor"), -0.1) << thing;
  }
  EXPECT_GT(weight(weights, "table", "coffee table"), weight(weights, "sofa", "coffee table"));
}

TEST(PlanLikelihoodTest, WhatIsAPartInSomeDegreeSaysAsMuchLess) {
  const WeightMatrix weights = matrix();
  EXPECT_NEAR(weight(weights, "painting", "floor"), 0.6 * weight(weights, "wall", "floor"), 1e-3);
  EXPECT_NEAR(weight(weights, "rug", "floor"), 0.9 * weight(weights, "floor", "floor"), 1e-3);
}

TEST(PlanLikelihoodTest, NoPixelSaysMoreThanAMeaninglessTenthAllows) {
  const WeightMatrix weights = matrix();
  for (const double value : weights.bands()[0].weights) {
    EXPECT_GE(value, std::log(0.1) - 1e-3);
    EXPECT_LE(value, 3.5);
  }
}

TEST(PlanLikelihoodTest, ClassesThatOnlyTheMapNamesGetRows) {
  const WeightMatrix weights = matrix();
  EXPECT_GT(weight(weights, "coffee table", "coffee table"), 2.0);
}

}  // namespace
}  // namespace semview::similarity
