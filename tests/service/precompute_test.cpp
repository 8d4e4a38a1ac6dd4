// SPDX-License-Identifier: Apache-2.0
#include "semview/service/precompute.hpp"

#include <map>

#include <gtest/gtest.h>

#include "semview/cache/lmdb_store.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/service/site.hpp"
#include "service/small_map.hpp"
#include "support/engine_wish.hpp"

namespace semview::service {
namespace {

using Records = std::map<std::vector<std::byte>, std::vector<std::byte>>;

Records records_of(const Site& site) {
  Records records;
  EXPECT_TRUE(site.tiers()
                  .store
                  ->for_each_record([&](auto key, auto record) {
                    records[{key.begin(), key.end()}] = {record.begin(), record.end()};
                  })
                  .has_value());
  return records;
}

class PrecomputeTest : public ::testing::Test {
 protected:
  std::shared_ptr<Site> open(const char* cache, std::size_t threads = 1, int rows = 24) {
    SiteConfig config;
    config.profile.camera = {120, rows, -0.7, 0.7};
    config.threads = threads;
    config.engine = testing::engine_wish();
    if (cache != nullptr) config.cache_directory = folder_.path() / cache;
    auto site = Site::open(map_, config);
    EXPECT_TRUE(site.has_value()) << (site ? "" : site.error().message);
    return site ? *site : nullptr;
  }
  PrecomputeResult run(const Site& site, const PrecomputePlan& plan) {
    auto result = run_precompute(site, plan, {}, {});
    EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().message);
    return result ? *result : PrecomputeResult{};
  }

  testing::TemporaryFolder folder_;
  const std::filesystem::path map_ = testing::write_small_map(folder_);
};

TEST_F(PrecomputeTest, PlansTheViewCellsOfAllFreeCells) {
  const auto site = open(nullptr);
  const auto plan = plan_precompute(*site, {});
  ASSERT_TRUE(plan.has_value());
  // 8 × 7 and 9 × 7 floor cells (the table's four are not free, their eyes are), two door cells
  // that stand for a neighbour, 4 × 2 in the closet.
  EXPECT_EQ(plan->free_cells, 56U + 63U - 4U + 2U + 8U);
  EXPECT_EQ(plan->cells.size(), 56U + 63U - 4U + 8U);
  EXPECT_TRUE(std::ranges::is_sorted(plan->cells));
  for (const CellIndex& cell : plan->cells) EXPECT_TRUE(site->cells().has_eye(cell));
}

TEST_F(PrecomputeTest, PlansPartsOfAMap) {
  const auto site = open(nullptr);
  PrecomputeRegion region;
  region.rectangle_m = {-0.4, 0.6, 0.0, 0.8};  // 4 × 2 cells; the lowest row is a wall
  auto plan = plan_precompute(*site, region);
  ASSERT_TRUE(plan.has_value());
  for (const CellIndex& cell : plan->cells) {
    EXPECT_TRUE(cell.ix >= -4 && cell.ix < 0 && cell.iy >= 6 && cell.iy < 8);
  }
  region = {};
  region.reachable_from_m = {0.0, 0.9};
  plan = plan_precompute(*site, region);
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->free_cells, 56U + 63U - 4U + 2U) << "both rooms, through the door, no closet";
  region.reachable_from_m = {-0.45, 0.9};  // in the wall
  EXPECT_EQ(plan_precompute(*site, region).error().field, "--reachable-from");
  region = {};
  region.rectangle_m = {1.0, 1.0, 0.0, 2.0};
  EXPECT_EQ(plan_precompute(*site, region).error().field, "--region");
  region.rectangle_m = {50.0, 50.0, 51.0, 51.0};
  EXPECT_EQ(plan_precompute(*site, region).error().code, ErrorCode::kNotFound);
}

TEST_F(PrecomputeTest, StoresWhatTheSiteThenServesFromDisk) {
  const auto site = open("cache");
  const auto plan = plan_precompute(*site, {});
  ASSERT_TRUE(plan.has_value());
  const PrecomputeResult result = run(*site, *plan);
  EXPECT_EQ(result.progress.cast, plan->cells.size());
  EXPECT_EQ(result.end, PrecomputeEnd::kComplete);
  const auto batch = site->views().views(site->cells().free_cells());
  ASSERT_TRUE(batch.has_value());
  EXPECT_EQ(batch->origins, (ViewOrigins{0, plan->cells.size(), 0}));
  const auto entries = site->tiers().store->keyspaces();
  ASSERT_TRUE(entries.has_value());
  ASSERT_EQ(entries->size(), 1U);
  EXPECT_TRUE((*entries)[0].complete());
  EXPECT_EQ((*entries)[0].map_id, "two_rooms");
}

TEST_F(PrecomputeTest, TheRecordsDoNotDependOnTheThreads) {
  const auto one = open("one", 1);
  const auto three = open("three", 3);
  const auto plan = plan_precompute(*one, {});
  ASSERT_TRUE(plan.has_value());
  run(*one, *plan);
  run(*three, *plan);
  EXPECT_EQ(records_of(*one), records_of(*three));
  EXPECT_EQ(records_of(*one).size(), plan->cells.size());
}

TEST_F(PrecomputeTest, StopsWhenAskedAndGoesOnWhereItStopped) {
  // Tall panoramas make small chunks.
  const auto site = open("cache", 1, 1024);
  const auto whole = open("whole", 1, 1024);
  const auto plan = plan_precompute(*site, {});
  ASSERT_TRUE(plan.has_value());
  std::stop_source stop;
  const auto stopped =
      run_precompute(*site, *plan, stop.get_token(), [&](const PrecomputeProgress& progress) {
        if (progress.cast > 0) stop.request_stop();
      });
  ASSERT_TRUE(stopped.has_value());
  EXPECT_EQ(stopped->end, PrecomputeEnd::kStopped);
  EXPECT_GT(stopped->progress.cast, 0U);
  EXPECT_LT(stopped->progress.cast, plan->cells.size());
  const PrecomputeResult resumed = run(*site, *plan);
  EXPECT_EQ(resumed.progress.found, stopped->progress.cast);
  EXPECT_EQ(resumed.progress.cast, plan->cells.size() - stopped->progress.cast);
  EXPECT_EQ(run(*site, *plan).progress.cast, 0U) << "nothing is computed again";
  run(*whole, *plan);
  EXPECT_EQ(records_of(*site), records_of(*whole));
}

TEST_F(PrecomputeTest, RangesAreStoredForAProfileThatAsksAndLieWithinAMillimetre) {
  run(*open("cache"), *plan_precompute(*open("cache"), {}));
  SiteConfig config;
  config.profile.camera = {120, 24, -0.7, 0.7};
  config.profile.ranges = true;
  config.cache_directory = folder_.path() / "cache";
  const auto site = *Site::open(map_, config);
  const auto plan = plan_precompute(*site, {});
  EXPECT_EQ(run(*site, *plan).progress.found, 0U) << "labels alone are stored under another key";
  const std::span<const CellIndex> cells = std::span(plan->cells).first(5);
  const auto stored = site->tiers().store->get(site->keyspace(), cells);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    ASSERT_NE(stored[i], nullptr);
    const auto cast = site->exact_panorama({PoseGrid::center(cells[i]),
                                            site->eye_z_m(config.profile.eye_height_m),
                                            config.profile.camera,
                                            {}});
    ASSERT_TRUE(cast.has_value());
    EXPECT_EQ(stored[i]->to_labels(), cast->labels);
    const RangeImage ranges_m = stored[i]->to_ranges(config.profile.camera);
    for (std::size_t k = 0; k < ranges_m.pixels().size(); ++k) {
      const float range_m = cast->ranges_m.pixels()[k];
      if (ranges_m.pixels()[k] == range_m) continue;  // both infinite
      ASSERT_NEAR(ranges_m.pixels()[k], range_m, 1e-3F) << "cell " << i << ", pixel " << k;
    }
  }
}

TEST_F(PrecomputeTest, TheEstimateStoresNothing) {
  const auto site = open("cache");
  const auto plan = plan_precompute(*site, {});
  ASSERT_TRUE(plan.has_value());
  const auto before = estimate_precompute(*site, *plan);
  ASSERT_TRUE(before.has_value());
  EXPECT_EQ(before->found, 0U);
  EXPECT_GT(before->sampled, 0U);
  EXPECT_GT(before->seconds, 0.0);
  EXPECT_TRUE(records_of(*site).empty());
  const std::uint64_t empty_bytes = site->tiers().store->file_bytes();
  run(*site, *plan);
  const std::uint64_t grown = site->tiers().store->file_bytes() - empty_bytes;
  // Inner pages and pages not yet full: within a factor of two and a few pages for a map this
  // small.
  constexpr std::uint64_t kFewPages = 4 * 4096;
  EXPECT_LT(before->bytes, 2 * grown + kFewPages);
  EXPECT_GT(2 * before->bytes + kFewPages, grown);
  const auto after = estimate_precompute(*site, *plan);
  ASSERT_TRUE(after.has_value());
  EXPECT_EQ(after->found, plan->cells.size());
  EXPECT_EQ(after->bytes, 0U);
}

TEST_F(PrecomputeTest, NeedsACacheDirectoryThatTakesRecords) {
  const auto none = open(nullptr);
  const auto plan = plan_precompute(*none, {});
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(run_precompute(*none, *plan, {}, {}).error().code, ErrorCode::kFailedPrecondition);
  SiteConfig config;
  config.profile.camera = {120, 24, -0.7, 0.7};
  config.cache_directory = folder_.path() / "full";
  config.engine = testing::engine_wish();
  config.cache_limit_bytes = 100'000;
  const auto full = Site::open(map_, config);
  ASSERT_TRUE(full.has_value());
  const auto result = run_precompute(**full, *plan, {}, {});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kResourceExhausted);
  EXPECT_TRUE((*full)->views().views(plan->cells).has_value()) << "serving goes on";
}

}  // namespace
}  // namespace semview::service
