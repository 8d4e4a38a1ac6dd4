// SPDX-License-Identifier: Apache-2.0
#include "client/load/most_robots.hpp"

#include <gtest/gtest.h>

namespace semview::client {
namespace {

/// A server that holds `limit` robots.
Result<MostRobots> search(std::size_t first,
                          std::size_t limit,
                          std::size_t most = 1000,
                          std::size_t fewest = 1) {
  return find_most_robots(
      fewest,
      first,
      most,
      [limit](std::size_t robots) -> Result<LoadReport> {
        LoadReport report;
        report.cycles = 100;
        report.in_time = robots <= limit ? 99 : 98;
        return report;
      },
      [] { return true; });
}

TEST(MostRobotsTest, TheLimitIsFoundWithinATwentieth) {
  for (const std::size_t limit : {1, 2, 3, 10, 33, 100, 517, 999, 1000}) {
    for (const std::size_t first : {1, 20, 800}) {
      const auto found = search(first, limit);
      ASSERT_TRUE(found);
      EXPECT_LE(found->robots, limit);
      EXPECT_GE(found->robots + std::max<std::size_t>(1, found->robots / 20), limit);
      EXPECT_LE(found->steps.size(), kMaxSearchSteps);
    }
  }
}

TEST(MostRobotsTest, AServerThatHoldsNobodyIsFoundOut) {
  const auto found = search(8, 0);
  EXPECT_EQ(found->robots, 0U);
  EXPECT_EQ(found->steps.back().robots, 1U);
}

TEST(MostRobotsTest, FewerThanCanBeToldAreNotTried) {
  for (const std::size_t limit : {1, 9, 10, 11, 50}) {
    const auto found = search(800, limit, 1000, 10);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->settled);
    EXPECT_LE(found->robots, limit);
    EXPECT_EQ(found->robots == 0, limit < 10);
    for (const LoadStep& step : found->steps) EXPECT_GE(step.robots, 10U);
  }
}

TEST(MostRobotsTest, ARunOfFewCyclesHoldsNothing) {
  LoadReport report;
  EXPECT_FALSE(holds(report));
  report.cycles = report.in_time = kFewestCycles - 1;
  EXPECT_FALSE(holds(report));
  report.cycles = report.in_time = kFewestCycles;
  EXPECT_TRUE(holds(report));
}

TEST(MostRobotsTest, EveryRunOfASearchHasCyclesEnough) {
  LoadConfig config;
  for (const double rate_hz : {0.3, 1.0, 2.0, 3.0, 7.0, 100.0}) {
    for (const double seconds : {4.0, 5.0, 5.1, 60.0}) {
      config.rate_hz = rate_hz;
      config.seconds = seconds;
      const auto robots = fewest_robots(config);
      ASSERT_TRUE(robots);
      EXPECT_GE(seconds * (rate_hz * static_cast<double>(*robots)), kFewestCycles);
      EXPECT_TRUE(*robots == 1 ||
                  seconds * rate_hz * static_cast<double>(*robots - 1) < kFewestCycles + 1e-9);
    }
  }
  config.rate_hz = 2.0;
  config.seconds = 0.001;
  EXPECT_EQ(fewest_robots(config).error().field, "--seconds");
}

TEST(MostRobotsTest, NoMoreThanAllowedAreTried) {
  const auto found = search(1, 1'000'000, 60);
  EXPECT_EQ(found->robots, 60U);
}

TEST(MostRobotsTest, WhenTheTimeIsUpTheSearchEndsUnsettled) {
  LoadReport held;
  held.cycles = held.in_time = 100;
  int left = 2;
  const auto found = find_most_robots(
      1,
      1,
      1000,
      [&](std::size_t) -> Result<LoadReport> { return held; },
      [&] { return left-- > 0; });
  EXPECT_EQ(found->steps.size(), 3U);
  EXPECT_EQ(found->robots, 4U);
  EXPECT_FALSE(found->settled);
  EXPECT_TRUE(search(1, 10)->settled);
}

TEST(MostRobotsTest, AnErrorEndsTheSearch) {
  int runs = 0;
  const auto found = find_most_robots(
      1,
      1,
      10,
      [&runs](std::size_t) -> Result<LoadReport> {
        if (++runs == 3) return fail(ErrorCode::kUnavailable, "gone");
        LoadReport report;
        report.cycles = report.in_time = 100;
        return report;
      },
      [] { return true; });
  EXPECT_EQ(found.error().code, ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace semview::client
