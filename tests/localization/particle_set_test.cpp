// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/particle_set.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace semview::localization {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

ParticleSet weighted(const std::vector<double>& weights) {
  ParticleSet particles;
  for (const double weight : weights) particles.push_back({.weight = weight});
  return particles;
}

TEST(ParticleSetTest, MultipliesAndNormalises) {
  ParticleSet particles = weighted({0.5, 0.25, 0.25});
  const std::vector<double> log_weights{std::log(1.0), std::log(2.0), std::log(4.0)};
  EXPECT_EQ(multiply_weights(particles, log_weights), WeightOutcome::kUsed);
  EXPECT_NEAR(particles[0].weight, 0.25, 1e-15);
  EXPECT_NEAR(particles[1].weight, 0.25, 1e-15);
  EXPECT_NEAR(particles[2].weight, 0.5, 1e-15);
}

TEST(ParticleSetTest, WeightsFarBelowTheSmallestNumberDoNotUnderflow) {
  ParticleSet particles = weighted({0.5, 0.5});
  EXPECT_EQ(multiply_weights(particles, std::vector<double>{-1.0e6, -1.0e6 + std::log(3.0)}),
            WeightOutcome::kUsed);
  EXPECT_NEAR(particles[0].weight, 0.25, 1e-9);
}

TEST(ParticleSetTest, ImpossibleNanAndPlusInfinityCountAsZero) {
  ParticleSet particles = weighted({0.25, 0.25, 0.25, 0.25});
  const std::vector<double> log_weights{-kInfinity, kNan, kInfinity, -3.0};
  EXPECT_EQ(multiply_weights(particles, log_weights), WeightOutcome::kUsed);
  EXPECT_EQ(particles[0].weight, 0.0);
  EXPECT_EQ(particles[1].weight, 0.0);
  EXPECT_EQ(particles[2].weight, 0.0);
  EXPECT_EQ(particles[3].weight, 1.0);
}

TEST(ParticleSetTest, NothingPossibleLeavesTheWeightsAsTheyWere) {
  for (const double value : {-kInfinity, kNan, kInfinity}) {
    ParticleSet particles = weighted({0.7, 0.3});
    const ParticleSet before = particles;
    EXPECT_EQ(multiply_weights(particles, std::vector<double>{value, value}),
              WeightOutcome::kUninformative);
    EXPECT_EQ(particles, before);
  }
  // Possible by the observation alone, but the particle had been ruled out before.
  ParticleSet particles = weighted({1.0, 0.0});
  EXPECT_EQ(multiply_weights(particles, std::vector<double>{-kInfinity, 0.0}),
            WeightOutcome::kUninformative);
  EXPECT_EQ(particles[0].weight, 1.0);
}

RC_GTEST_PROP(ParticleSetTest, ACommonOffsetChangesNothingBeyondRounding, ()) {
  const auto raw =
      *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(-50, 50)));
  const double offset = *rc::gen::inRange(-1000, 1000);
  ParticleSet a = weighted(std::vector<double>(raw.size(), 1.0 / static_cast<double>(raw.size())));
  ParticleSet b = a;
  std::vector<double> log_weights(raw.begin(), raw.end());
  RC_ASSERT(multiply_weights(a, log_weights) == WeightOutcome::kUsed);
  for (double& value : log_weights) value += offset;
  RC_ASSERT(multiply_weights(b, log_weights) == WeightOutcome::kUsed);
  double total = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    RC_ASSERT(std::abs(a[i].weight - b[i].weight) < 1e-9);
    total += a[i].weight;
  }
  RC_ASSERT(std::abs(total - 1.0) < 1e-12);
}

TEST(ParticleSetTest, EffectiveSampleSizeIsOneOverTheSumOfSquares) {
  EXPECT_NEAR(effective_sample_size(weighted({0.25, 0.25, 0.25, 0.25})), 4.0, 1e-12);
  EXPECT_NEAR(effective_sample_size(weighted({1.0, 0.0, 0.0})), 1.0, 1e-12);
  EXPECT_NEAR(effective_sample_size(weighted({0.5, 0.3, 0.2})), 1.0 / 0.38, 1e-12);
}

}  // namespace
}  // namespace semview::localization
