// SPDX-License-Identifier: Apache-2.0
#include "semview/cache/memory_tier.hpp"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "semview/core/random.hpp"
#include "support/cache_samples.hpp"

namespace semview::cache {
namespace {

SharedView sized_view(int columns, int rows) {
  return std::make_shared<const ColumnView>(ColumnView::from_labels(LabelImage(rows, columns, 1)));
}

std::uint64_t cost(const SharedView& view) {
  return view->byte_size() + MemoryTier::kOverhead_bytes;
}

TEST(MemoryTierTest, DropsTheViewUnusedForLongest) {
  const std::vector<SharedView> views(4, sized_view(120, 12));
  MemoryTier tier(3 * cost(views[0]));
  const std::vector<CellIndex> cells = {{0, 0}, {1, 0}, {2, 0}, {3, 0}};
  for (std::size_t i = 0; i < 3; ++i) {
    tier.put(test_keyspace(), std::span(cells).subspan(i, 1), std::span(views).subspan(i, 1));
  }
  EXPECT_NE(tier.get(test_keyspace(), std::span(cells).first(1))[0], nullptr);
  tier.put(test_keyspace(), std::span(cells).subspan(3, 1), std::span(views).subspan(3, 1));
  const std::vector<SharedView> found = tier.get(test_keyspace(), cells);
  EXPECT_NE(found[0], nullptr);
  EXPECT_EQ(found[1], nullptr);
  EXPECT_NE(found[2], nullptr);
  EXPECT_NE(found[3], nullptr);
  EXPECT_EQ(tier.counters().evicted, 1U);
  EXPECT_EQ(tier.counters().views, 3U);
  EXPECT_EQ(tier.counters().bytes, 3 * cost(views[0]));
}

TEST(MemoryTierTest, RefusesAViewLargerThanTheBudgetAndKeepsTheRest) {
  const SharedView small = sized_view(120, 12);
  const SharedView large = sized_view(3600, 12);
  MemoryTier tier(2 * cost(small));
  ASSERT_GT(cost(large), 2 * cost(small));
  const std::vector<CellIndex> cells = {{0, 0}, {1, 0}};
  tier.put(test_keyspace(), cells, std::vector{small, large});
  const std::vector<SharedView> found = tier.get(test_keyspace(), cells);
  EXPECT_NE(found[0], nullptr);
  EXPECT_EQ(found[1], nullptr);
  EXPECT_EQ(tier.counters().refused, 1U);
}

TEST(MemoryTierTest, OneLargeViewTakesThePlaceOfManySmallOnes) {
  const SharedView small = sized_view(120, 12);
  const SharedView large = sized_view(1200, 12);
  MemoryTier tier(cost(large) + cost(small));
  const std::vector<CellIndex> cells = test_cells(8);
  tier.put(test_keyspace(), cells, std::vector<SharedView>(8, small));
  const std::vector<CellIndex> cell = {{50, 50}};
  tier.put(test_keyspace(), cell, std::vector{large});
  EXPECT_NE(tier.get(test_keyspace(), cell)[0], nullptr);
  EXPECT_LE(tier.counters().bytes, cost(large) + cost(small));
}

TEST(MemoryTierTest, ABudgetOfNothingKeepsNothing) {
  MemoryTier tier(0);
  const std::vector<CellIndex> cell = {{0, 0}};
  tier.put(test_keyspace(), cell, std::vector{sized_view(120, 12)});
  EXPECT_EQ(tier.get(test_keyspace(), cell)[0], nullptr);
  EXPECT_EQ(tier.counters().bytes, 0U);
}

TEST(MemoryTierTest, NeverExceedsItsBudgetWhileThreadsFillIt) {
  constexpr std::uint64_t kBudget = 40'000;
  MemoryTier tier(kBudget);
  std::atomic<bool> done{false};
  std::atomic<std::uint64_t> highest{0};
  std::thread watcher([&] {
    while (!done) highest = std::max(highest.load(), tier.counters().bytes);
  });
  std::vector<std::thread> writers;
  for (std::uint64_t t = 0; t < 3; ++t) {
    writers.emplace_back([&tier, t] {
      Rng rng(t, "sizes");
      for (int i = 0; i < 400; ++i) {
        const std::vector<CellIndex> cell = {{static_cast<std::int32_t>(rng.below(50)), 0}};
        const int columns = 120 * static_cast<int>(1 + rng.below(20));
        tier.put(test_keyspace(), cell, std::vector{sized_view(columns, 4)});
      }
    });
  }
  for (std::thread& writer : writers) writer.join();
  done = true;
  watcher.join();
  EXPECT_LE(highest.load(), kBudget);
  EXPECT_LE(tier.counters().bytes, kBudget);
  EXPECT_GT(tier.counters().evicted, 0U);
}

}  // namespace
}  // namespace semview::cache
