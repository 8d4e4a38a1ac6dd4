// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/combined_heading.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace semview::observation {
namespace {

constexpr SimilarityWeightingConfig kExponential{.transform = WeightTransform::kExponential,
                                                 .kappa = 10.0};

ScoreBatch scale_of_one() {
  ScoreBatch batch;
  batch.weight_scale = 1000;
  batch.observed_pixels = 1;
  return batch;
}

std::vector<std::int32_t> flat_curve(std::int32_t value) {
  return std::vector<std::int32_t>(PoseGrid::kHeadings, value);
}

TEST(CombinedHeadingTest, ALevelCurveLeavesTheCarriedHeadingToWithinTheGrid) {
  for (const double yaw_deg : {-179.0, -91.4, 0.0, 1.4, 178.6}) {
    const HeadingChoice choice =
        combine_heading(flat_curve(300), scale_of_one(), rad_from_deg(yaw_deg), kExponential, {});
    EXPECT_LE(std::abs(wrap_angle(choice.heading_rad - rad_from_deg(yaw_deg))), rad_from_deg(0.05))
        << yaw_deg;
  }
}

TEST(CombinedHeadingTest, WeightIsThatOfSimilarityTimesPrior) {
  std::vector<std::int32_t> curve = flat_curve(0);
  curve[10] = 900;  // 30 degrees
  const CombinedHeadingConfig config{.sigma_rad = rad_from_deg(10.0), .lost_probability = 0.01};
  const HeadingChoice choice =
      combine_heading(curve, scale_of_one(), rad_from_deg(24.0), kExponential, config);
  const double prior = 0.99 * std::exp(-0.5 * 0.6 * 0.6) + 0.01;
  EXPECT_NEAR(choice.log_weight, 10.0 * 0.9 + std::log(prior), 1e-9);
}

TEST(CombinedHeadingTest, ALostHeadingComesBackWhenTheViewSaysSoLoudly) {
  std::vector<std::int32_t> curve = flat_curve(0);
  curve[60] = 1000;
  const CombinedHeadingConfig config{.sigma_rad = rad_from_deg(6.0), .lost_probability = 0.001};
  const HeadingChoice faint =
      combine_heading(curve,
                      scale_of_one(),
                      0.0,
                      {.transform = WeightTransform::kExponential, .kappa = 5.0},
                      config);
  EXPECT_LT(std::abs(faint.heading_rad), rad_from_deg(3.0));
  const HeadingChoice loud =
      combine_heading(curve,
                      scale_of_one(),
                      0.0,
                      {.transform = WeightTransform::kExponential, .kappa = 20.0},
                      config);
  EXPECT_GT(std::abs(loud.heading_rad), rad_from_deg(177.0));
}

TEST(CombinedHeadingTest, ThePeakLiesBetweenHeadingsWhereNeighboursSaySo) {
  // exp(kappa s) with s a parabola around 31 degrees: the logarithm is that parabola.
  std::vector<std::int32_t> curve;
  for (int k = 0; k < PoseGrid::kHeadings; ++k) {
    const double off = deg_from_rad(wrap_angle(PoseGrid::heading_yaw_rad(k) - rad_from_deg(31.0)));
    curve.push_back(static_cast<std::int32_t>(std::lround(1e6 - 10.0 * off * off)));
  }
  const HeadingChoice choice =
      combine_heading(curve, scale_of_one(), std::nullopt, kExponential, {});
  EXPECT_NEAR(deg_from_rad(choice.heading_rad), 31.0, 0.01);
}

TEST(CombinedHeadingTest, NoPossibleHeadingIsImpossible) {
  const HeadingChoice choice =
      combine_heading(flat_curve(-5), scale_of_one(), 0.0, {.power = 2.0}, {});
  EXPECT_TRUE(std::isnan(choice.heading_rad));
  EXPECT_EQ(choice.log_weight, -INFINITY);
}

TEST(CombinedHeadingTest, ParametersOutOfRangeAreNamed) {
  EXPECT_EQ(validate(CombinedHeadingConfig{.sigma_rad = 0.0}).error().field, "sigma_rad");
  EXPECT_EQ(validate(CombinedHeadingConfig{.lost_probability = 0.0}).error().field,
            "lost_probability");
  EXPECT_TRUE(validate(CombinedHeadingConfig{}));
}

}  // namespace
}  // namespace semview::observation
