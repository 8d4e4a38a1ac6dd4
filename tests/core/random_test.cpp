// SPDX-License-Identifier: Apache-2.0
#include "semview/core/random.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace semview {
namespace {

TEST(RngTest, SameSeedAndStreamGiveTheSameNumbers) {
  Rng a(7, "odometry", 3);
  Rng b(7, "odometry", 3);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.next_u64(), b.next_u64());
}

TEST(RngTest, SeedStreamAndIndexEachMakeAnotherSequence) {
  const std::uint64_t first = Rng(7, "odometry", 3).next_u64();
  EXPECT_NE(first, Rng(8, "odometry", 3).next_u64());
  EXPECT_NE(first, Rng(7, "camera", 3).next_u64());
  EXPECT_NE(first, Rng(7, "odometry", 4).next_u64());
}

// n = 100 000: the standard error of a mean of uniforms is 0.29/√n = 0.0009, of normals 1/√n =
// 0.0032, of a variance of normals √(2/n) = 0.0045; five of them are allowed.
TEST(RngTest, UniformNumbersFillTheirInterval) {
  Rng rng(1, "uniform");
  double sum = 0.0;
  for (int i = 0; i < 100'000; ++i) {
    const double value = rng.uniform(-1.0, 1.0);
    ASSERT_GE(value, -1.0);
    ASSERT_LT(value, 1.0);
    sum += value;
  }
  EXPECT_NEAR(sum / 1e5, 0.0, 0.01);
}

TEST(RngTest, NormalNumbersHaveTheirMeanAndSpread) {
  Rng rng(2, "normal");
  double sum = 0.0;
  double squares = 0.0;
  int beyond_two_sigma = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double value = rng.normal(0.0, 1.0);
    ASSERT_TRUE(std::isfinite(value));
    sum += value;
    squares += value * value;
    if (std::abs(value) > 2.0) ++beyond_two_sigma;
  }
  EXPECT_NEAR(sum / 1e5, 0.0, 0.016);
  EXPECT_NEAR(squares / 1e5, 1.0, 0.023);
  EXPECT_NEAR(beyond_two_sigma / 1e5, 0.0455, 0.0033);
}

TEST(RngTest, NoSpreadGivesTheMean) {
  Rng rng(3);
  EXPECT_EQ(rng.normal(4.5, 0.0), 4.5);
}

// 60 000 throws of a die: each face 10 000 ± 5·√(60000·1/6·5/6) = ± 457.
TEST(RngTest, BelowIsEvenlySpread) {
  Rng rng(4, "die");
  std::array<int, 6> counts{};
  for (int i = 0; i < 60'000; ++i) ++counts.at(rng.below(6));
  for (const int count : counts) EXPECT_NEAR(count, 10'000, 457);
}

TEST(RngTest, BelowOneIsZero) {
  Rng rng(5);
  EXPECT_EQ(rng.below(1), 0U);
}

}  // namespace
}  // namespace semview
