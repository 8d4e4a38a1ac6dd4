// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/low_variance_resampling.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace semview::localization {
namespace {

std::vector<std::size_t> counts(const std::vector<std::uint32_t>& ancestors, std::size_t size) {
  std::vector<std::size_t> result(size, 0);
  for (const std::uint32_t ancestor : ancestors) ++result.at(ancestor);
  return result;
}

RC_GTEST_PROP(LowVarianceResamplingTest, CountsAreWithinOneOfTheirExpectation, ()) {
  const auto raw = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 1000));
  std::vector<double> weights(raw.begin(), raw.end());
  weights.push_back(1.0);
  const auto count = *rc::gen::inRange<std::size_t>(1, 500);
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const auto drawn = low_variance_sample(weights, count, rng);
  RC_ASSERT(drawn.size() == count);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const auto found = counts(drawn, weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double expected = weights[i] * static_cast<double>(count) / total;
    RC_ASSERT(std::abs(static_cast<double>(found[i]) - expected) < 1.0 + 1e-9);
    if (weights[i] == 0.0) RC_ASSERT(found[i] == 0U);
  }
}

TEST(LowVarianceResamplingTest, IsUnbiased) {
  const std::vector<double> weights{0.11, 0.27, 0.02, 0.6};
  constexpr int kRuns = 20000;
  constexpr std::size_t kCount = 7;
  std::vector<double> sums(weights.size(), 0.0);
  Rng rng(5);
  for (int run = 0; run < kRuns; ++run) {
    const auto found = counts(low_variance_sample(weights, kCount, rng), weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i) sums[i] += static_cast<double>(found[i]);
  }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    // A count is one of two neighbouring integers: its variance is f (1 - f) <= 1/4.
    const double expected = weights[i] * static_cast<double>(kCount);
    EXPECT_NEAR(sums[i] / kRuns, expected, 4.0 * 0.5 / std::sqrt(kRuns));
  }
}

TEST(LowVarianceResamplingTest, EqualWeightsKeepEveryParticle) {
  Rng rng(3);
  const std::vector<double> weights(257, 1.0 / 257.0);
  const auto found = counts(low_variance_sample(weights, 257, rng), 257);
  // Rounding of the running sum may move one mark across a border, never lose the total.
  for (const std::size_t count : found) EXPECT_LE(count, 2U);
}

TEST(LowVarianceResamplingTest, ImpossibleParticlesAtTheEndsAreNeverDrawn) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    for (const std::uint32_t ancestor :
         low_variance_sample(std::vector<double>{0.0, 0.1, 0.2, 0.3, 0.0}, 1000, rng)) {
      ASSERT_TRUE(ancestor >= 1 && ancestor <= 3);
    }
  }
}

}  // namespace
}  // namespace semview::localization
