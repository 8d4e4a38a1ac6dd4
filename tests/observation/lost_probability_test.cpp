// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/lost_probability.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace semview::observation {
namespace {

TEST(LostProbabilityTest, FeaturesAreRelativeToOtherPlacesAndDoNotDependOnTheScaleOfWeights) {
  for (const double scale : {0.01, 1.0, 30.0}) {
    LostWatch watch;
    const LostFeatures good = watch.look({0.8 * scale, 0.6 * scale, 0.2 * scale}, 0.95, 0.1, 0.3);
    EXPECT_NEAR(good.advantage, 1.0 / 3.0, 1e-12);
    EXPECT_NEAR(good.advantage_before, 1.0 / 3.0, 1e-12) << "nothing was before the first frame";
    const LostFeatures bad = watch.look({0.2 * scale, 0.6 * scale, 0.2 * scale}, 0.5, 0.1, 0.3);
    EXPECT_NEAR(bad.advantage, -1.0, 1e-12);
    EXPECT_NEAR(bad.advantage_before, 1.0 / 3.0, 1e-12);
    EXPECT_GT(lost_probability(bad), lost_probability(good));
    const LostFeatures third = watch.look({0.2 * scale, 0.6 * scale, 0.2 * scale}, 0.5, 0.1, 0.3);
    EXPECT_NEAR(third.advantage_before, -1.0 / 3.0, 1e-12);
    EXPECT_GE(lost_probability(third), lost_probability(bad));
  }
}

TEST(LostProbabilityTest, WhatFitsEverywhereAlikeGivesFiniteFeatures) {
  LostWatch watch;
  const LostFeatures features = watch.look({0.3, 0.3, 0.3}, 0.0, 0.0, 0.0);
  for (const double value : features.values()) EXPECT_TRUE(std::isfinite(value));
  const double probability = lost_probability(features);
  EXPECT_GE(probability, 0.0);
  EXPECT_LE(probability, 1.0);
}

TEST(LostProbabilityTest, TheModelIsALogisticRegression) {
  const LostModel model{-1.0, {2.0, 0.0, 0.0, 0.5, 0.0}};
  LostFeatures features;
  features.advantage = 0.25;
  features.log_sigma = -3.0;
  EXPECT_NEAR(lost_probability(features, model), 1.0 / (1.0 + std::exp(2.0)), 1e-12);
}

}  // namespace
}  // namespace semview::observation
