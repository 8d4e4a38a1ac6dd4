// SPDX-License-Identifier: Apache-2.0
#include "client/load/most_robots.hpp"

#include <gtest/gtest.h>

namespace semview::client {
namespace {

/// A server that holds `limit` robots.
Result<MostRobots> search(std::size_t first, std::size_t limit, std::size_t most = 1000) {
  return find_most_robots(
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

TEST(MostRobotsTest, NoMoreThanAllowedAreTried) {
  const auto found = search(1, 1'000'000, 60);
  EXPECT_EQ(found->robots, 60U);
}

TEST(MostRobotsTest, WhenTheTimeIsUpTheSearchEndsUnsettled) {
  LoadReport held;
  held.cycles = held.in_time = 100;
  int left = 2;
  const auto found = find_most_robots(
      1, 1000, [&](std::size_t) -> Result<LoadReport> { return held; }, [&] { return left-- > 0; });
  EXPECT_EQ(found->steps.size(), 3U);
  EXPECT_EQ(found->robots, 4U);
  EXPECT_FALSE(found->settled);
  EXPECT_TRUE(search(1, 10)->settled);
}

TEST(MostRobotsTest, AnErrorEndsTheSearch) {
  int runs = 0;
  const auto found = find_most_robots(
      1,
      10,
      [&runs](std::size_t) -> Result<LoadReport> {
        if (++runs == 3) return fail(ErrorCode::kUnavailable, "gone");
        LoadReport report;
        report.cycles = report.in_time = 1;
        return report;
      },
      [] { return true; });
  EXPECT_EQ(found.error().code, ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace semview::client
