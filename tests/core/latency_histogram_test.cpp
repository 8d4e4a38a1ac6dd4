// SPDX-License-Identifier: Apache-2.0
#include "semview/core/latency_histogram.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "semview/core/random.hpp"

namespace semview {
namespace {

using std::chrono::microseconds;

TEST(LatencyHistogramTest, NothingYetIsAllZero) {
  const LatencySummary summary = LatencyHistogram().summary();
  EXPECT_EQ(summary.count, 0U);
  EXPECT_EQ(summary.p99_ms, 0.0);
  EXPECT_EQ(summary.max_ms, 0.0);
}

TEST(LatencyHistogramTest, OneDurationIsAllPercentiles) {
  for (const int us : {1, 15, 16, 17, 31, 32, 33, 1000, 123'456, 99'999'999}) {
    LatencyHistogram histogram;
    histogram.add(microseconds(us));
    const LatencySummary summary = histogram.summary();
    EXPECT_DOUBLE_EQ(summary.p50_ms, us / 1000.0);
    EXPECT_DOUBLE_EQ(summary.max_ms, us / 1000.0);
  }
}

TEST(LatencyHistogramTest, PercentilesAreThoseOfTheSortedDurationsWithinASixteenth) {
  Rng rng(1);
  LatencyHistogram histogram;
  std::vector<double> sorted_ms;
  for (int i = 0; i < 5000; ++i) {
    const auto us = static_cast<std::int64_t>(std::exp(rng.uniform(0.0, 17.0))) + 1;
    histogram.add(microseconds(us));
    sorted_ms.push_back(static_cast<double>(us) / 1000.0);
  }
  std::ranges::sort(sorted_ms);
  const LatencySummary summary = histogram.summary();
  EXPECT_EQ(summary.count, 5000U);
  for (const auto& [rank, value] : {std::pair(2500, summary.p50_ms),
                                    std::pair(4750, summary.p95_ms),
                                    std::pair(4950, summary.p99_ms)}) {
    const double truth = sorted_ms[static_cast<std::size_t>(rank) - 1];
    EXPECT_GE(value, truth);
    EXPECT_LE(value, truth * 1.0625);
  }
  EXPECT_EQ(summary.max_ms, sorted_ms.back());
}

TEST(LatencyHistogramTest, DurationsOutsideItsRangeCountAtItsEnds) {
  LatencyHistogram histogram;
  histogram.add(microseconds(-5));
  histogram.add(std::chrono::hours(100));
  EXPECT_EQ(histogram.summary().count, 2U);
  EXPECT_EQ(histogram.summary().p50_ms, 0.001);
  EXPECT_EQ(histogram.summary().max_ms, 3'600'000.0);
}

}  // namespace
}  // namespace semview
