// SPDX-License-Identifier: Apache-2.0
#include "semview/cache/view_cache.hpp"

#include <atomic>
#include <latch>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "semview/cache/memory_tier.hpp"
#include "support/cache_samples.hpp"

namespace semview::cache {
namespace {

SharedView view_of(const CellIndex& cell) {
  return testing::shared_random_view(std::hash<CellIndex>()(cell));
}

Result<std::vector<SharedView>> make_views(std::span<const CellIndex> cells) {
  std::vector<SharedView> views;
  for (const CellIndex& cell : cells) views.push_back(view_of(cell));
  return views;
}

Result<std::vector<SharedView>> never(std::span<const CellIndex>) {
  ADD_FAILURE() << "nothing should be computed";
  return fail(ErrorCode::kInternal, "computed");
}

class ViewCacheTest : public ::testing::Test {
 protected:
  const Keyspace keyspace_ = test_keyspace();
  const std::vector<CellIndex> cells_ = test_cells(10);
  const std::shared_ptr<MemoryTier> memory_ = std::make_shared<MemoryTier>(1U << 22U);
  // Any store can be the lower tier; this one needs no files.
  const std::shared_ptr<MemoryTier> disk_ = std::make_shared<MemoryTier>(1U << 22U);
};

TEST_F(ViewCacheTest, AnswersInOrderAndCountsDistinctCells) {
  ViewCache cache(memory_, disk_);
  const std::vector<CellIndex> asked = {cells_[3], cells_[0], cells_[3]};
  const auto batch = cache.get_or_compute(keyspace_, asked, make_views);
  ASSERT_TRUE(batch.has_value());
  ASSERT_EQ(batch->views.size(), 3U);
  EXPECT_EQ(*batch->views[0], *view_of(cells_[3]));
  EXPECT_EQ(*batch->views[1], *view_of(cells_[0]));
  EXPECT_EQ(batch->views[0], batch->views[2]);
  EXPECT_EQ(batch->origins, (ViewOrigins{0, 0, 2}));
}

TEST_F(ViewCacheTest, AsksMemoryThenDiskThenComputes) {
  memory_->put(keyspace_, std::span(cells_).first(2), *make_views(std::span(cells_).first(2)));
  disk_->put(
      keyspace_, std::span(cells_).subspan(2, 3), *make_views(std::span(cells_).subspan(2, 3)));
  ViewCache cache(memory_, disk_);
  const auto first = cache.get_or_compute(keyspace_, cells_, make_views);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->origins, (ViewOrigins{2, 3, 5}));
  const auto second = cache.get_or_compute(keyspace_, cells_, never);
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->origins, (ViewOrigins{10, 0, 0}));
  // Only what was cast has gone to disk: the test put the first two into memory alone.
  ViewCache restarted(std::make_shared<MemoryTier>(1U << 22U), disk_);
  const auto stored = std::span(cells_).subspan(2);
  const auto third = restarted.get_or_compute(keyspace_, stored, never);
  ASSERT_TRUE(third.has_value());
  EXPECT_EQ(third->origins, (ViewOrigins{0, 8, 0}));
  for (std::size_t i = 0; i < stored.size(); ++i) {
    EXPECT_EQ(*third->views[i], *view_of(stored[i]));
  }
}

TEST_F(ViewCacheTest, ViewsOfDistortedMapsPushNothingOutAndAreNeverOnDisk) {
  const auto distorted = std::make_shared<MemoryTier>(1U << 20U);
  ViewCache cache(memory_, disk_, distorted);
  ASSERT_TRUE(cache.get_or_compute(keyspace_, cells_, make_views));
  const StoreCounters memory = memory_->counters();
  const StoreCounters disk = disk_->counters();
  Keyspace drawn = keyspace_;
  for (int step = 1; step <= 5; ++step) {
    drawn.affine = affine_of(AffineSteps{step, 0, 0});
    const auto batch = cache.get_or_compute(drawn, cells_, make_views);
    ASSERT_TRUE(batch);
    EXPECT_EQ(batch->origins, (ViewOrigins{0, 0, cells_.size()}));
  }
  const auto again = cache.get_or_compute(drawn, cells_, never);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->origins, (ViewOrigins{cells_.size(), 0, 0}));
  EXPECT_EQ(memory_->counters().views, memory.views);
  EXPECT_EQ(disk_->counters().views, disk.views);
  EXPECT_EQ(disk_->counters().misses, disk.misses);
  EXPECT_EQ(cache.counters().memory.views, memory.views + distorted->counters().views);
}

TEST_F(ViewCacheTest, ServesWithTiersThatKeepNothing) {
  ViewCache cache(std::make_shared<MemoryTier>(0), std::make_shared<MemoryTier>(0));
  for (int i = 0; i < 2; ++i) {
    const auto batch = cache.get_or_compute(keyspace_, cells_, make_views);
    ASSERT_TRUE(batch.has_value());
    EXPECT_EQ(batch->origins.cast, 10U);
  }
}

TEST_F(ViewCacheTest, PassesErrorsOnAndTriesAgainNextTime) {
  ViewCache cache(memory_, nullptr);
  const auto failed = cache.get_or_compute(keyspace_, cells_, [](auto) {
    return Result<std::vector<SharedView>>(fail(ErrorCode::kUnavailable, "not now"));
  });
  ASSERT_FALSE(failed.has_value());
  EXPECT_EQ(failed.error().code, ErrorCode::kUnavailable);
  EXPECT_TRUE(cache.get_or_compute(keyspace_, cells_, make_views).has_value());
  EXPECT_EQ(cache.counters().failed, 1U);
}

TEST_F(ViewCacheTest, ExceptionsAndWrongCountsBecomeErrors) {
  ViewCache cache(memory_, nullptr);
  const auto thrown =
      cache.get_or_compute(keyspace_, cells_, [](auto) -> Result<std::vector<SharedView>> {
        throw std::runtime_error("boom");
      });
  ASSERT_FALSE(thrown.has_value());
  EXPECT_EQ(thrown.error().code, ErrorCode::kInternal);
  const auto odd = cache.get_or_compute(
      keyspace_, cells_, [](auto) -> Result<std::vector<SharedView>> { throw 42; });
  EXPECT_FALSE(odd.has_value());
  const auto few = cache.get_or_compute(
      keyspace_, cells_, [](auto cells) { return make_views(cells.first(1)); });
  EXPECT_FALSE(few.has_value());
  EXPECT_TRUE(cache.get_or_compute(keyspace_, cells_, make_views).has_value());
}

TEST_F(ViewCacheTest, CellsWithoutAViewAreAnsweredAndNotKept) {
  ViewCache cache(memory_, disk_);
  for (int i = 0; i < 2; ++i) {
    const auto batch = cache.get_or_compute(keyspace_, cells_, [](auto cells) {
      return Result<std::vector<SharedView>>(std::vector<SharedView>(cells.size()));
    });
    ASSERT_TRUE(batch.has_value());
    EXPECT_EQ(batch->views[4], nullptr);
    EXPECT_EQ(batch->origins.cast, 10U);
  }
}

TEST_F(ViewCacheTest, SeveralThreadsMakeAViewOnce) {
  ViewCache cache(memory_, disk_);
  std::atomic<std::size_t> made{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
      for (std::int32_t round = 0; round < 30; ++round) {
        std::vector<CellIndex> wanted;
        for (std::int32_t i = 0; i < 6; ++i) wanted.push_back({round, (i + t) % 8});
        const auto batch = cache.get_or_compute(keyspace_, wanted, [&made](auto cells) {
          made += cells.size();
          return make_views(cells);
        });
        ASSERT_TRUE(batch.has_value());
        for (std::size_t i = 0; i < wanted.size(); ++i) {
          EXPECT_EQ(*batch->views[i], *view_of(wanted[i]));
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(made.load(), 30U * 8U);
  EXPECT_EQ(cache.counters().cast, 30U * 8U);
}

TEST_F(ViewCacheTest, EveryWaiterIsAnsweredWhenTheMakerFails) {
  ViewCache cache(memory_, nullptr);
  std::latch started(1);
  std::latch go(1);
  std::atomic<int> failed{0};
  std::thread maker([&] {
    const auto batch =
        cache.get_or_compute(keyspace_, cells_, [&](auto) -> Result<std::vector<SharedView>> {
          started.count_down();
          go.wait();
          throw std::runtime_error("boom");
        });
    if (!batch) ++failed;
  });
  started.wait();
  std::vector<std::thread> waiters;
  for (int i = 0; i < 3; ++i) {
    waiters.emplace_back([&] {
      if (!cache.get_or_compute(keyspace_, cells_, never)) ++failed;
    });
  }
  while (cache.counters().waits < 30) std::this_thread::yield();
  go.count_down();
  maker.join();
  for (std::thread& waiter : waiters) waiter.join();
  EXPECT_EQ(failed.load(), 4);
}

}  // namespace
}  // namespace semview::cache
