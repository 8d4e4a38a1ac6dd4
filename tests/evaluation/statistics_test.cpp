// SPDX-License-Identifier: Apache-2.0
#include "semview/evaluation/statistics.hpp"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semview::evaluation {
namespace {

using ::testing::ElementsAre;

TEST(StatisticsTest, QuantilesLieLinearlyBetweenNeighbours) {
  const std::vector<double> values{4.0, 1.0, 3.0, 2.0};
  EXPECT_DOUBLE_EQ(mean(values), 2.5);
  EXPECT_DOUBLE_EQ(median(values), 2.5);
  EXPECT_DOUBLE_EQ(quantile(values, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile(values, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(quantile(values, 0.25), 1.75);  // 1 + 0.75 · (2 - 1)
  EXPECT_DOUBLE_EQ(median(std::vector<double>{5.0, 9.0, 7.0}), 7.0);
}

TEST(StatisticsTest, OfNothingIsNotANumber) {
  Rng rng(1);
  EXPECT_TRUE(std::isnan(mean({})));
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_TRUE(std::isnan(share_above({}, 1.0)));
  EXPECT_TRUE(std::isnan(bootstrap_mean({}, 0.95, 10, rng).low));
}

TEST(StatisticsTest, ShareAboveLeavesTheLimitOut) {
  EXPECT_DOUBLE_EQ(share_above(std::vector<double>{0.1, 0.3, 0.5, 0.7}, 0.3), 0.5);
}

TEST(StatisticsTest, BootstrapOfEqualValuesIsThatValue) {
  Rng rng(1);
  const Interval interval = bootstrap_mean(std::vector<double>(6, 0.25), 0.95, 100, rng);
  EXPECT_DOUBLE_EQ(interval.low, 0.25);
  EXPECT_DOUBLE_EQ(interval.high, 0.25);
}

TEST(StatisticsTest, BootstrapOfTwoValuesTakesEachMeanAsOftenAsChanceDoes) {
  // Means of two draws from {0, 1}: 0 and 1 in a quarter each, ½ in half. So the middle 40 % are
  // all ½, and the middle 80 % reach both ends.
  const std::vector<double> values{0.0, 1.0};
  Rng rng(7);
  const Interval narrow = bootstrap_mean(values, 0.4, 4000, rng);
  EXPECT_DOUBLE_EQ(narrow.low, 0.5);
  EXPECT_DOUBLE_EQ(narrow.high, 0.5);
  const Interval wide = bootstrap_mean(values, 0.8, 4000, rng);
  EXPECT_DOUBLE_EQ(wide.low, 0.0);
  EXPECT_DOUBLE_EQ(wide.high, 1.0);
}

TEST(StatisticsTest, BootstrapIsAsWideAsTheNormalTheorySaysOfManyValues) {
  Rng source(3);
  std::vector<double> values;
  for (int i = 0; i < 400; ++i) values.push_back(source.normal(2.0, 0.5));
  Rng rng(4);
  const Interval interval = bootstrap_mean(values, 0.95, 4000, rng);
  // ±1.96 · 0.5 / √400 = ±0.049; the sample's own σ and 4000 draws leave a tenth open.
  EXPECT_NEAR(interval.high - interval.low, 0.098, 0.010);
  EXPECT_LT(interval.low, 2.0);
  EXPECT_GT(interval.high, 2.0);
}

TEST(StatisticsTest, WhiskersEndAtTheLastValueWithinOneAndAHalfBoxes) {
  const std::vector<double> values{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 14.0};
  const BoxSummary box = box_summary(values);
  EXPECT_DOUBLE_EQ(box.low_quartile, 3.0);
  EXPECT_DOUBLE_EQ(box.median, 5.0);
  EXPECT_DOUBLE_EQ(box.high_quartile, 7.0);  // whiskers within [-3, 13]
  EXPECT_DOUBLE_EQ(box.low_whisker, 1.0);
  EXPECT_DOUBLE_EQ(box.high_whisker, 8.0);
  EXPECT_THAT(box.outliers, ElementsAre(14.0));
}

}  // namespace
}  // namespace semview::evaluation
