// SPDX-License-Identifier: Apache-2.0
/// What every ViewStore must do; instantiate with a factory for each implementation.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "semview/cache/view_store.hpp"
#include "support/cache_samples.hpp"

namespace semview::cache {

struct ViewStoreFactory {
  std::string name;
  std::function<std::shared_ptr<ViewStore>()> make;  ///< with room for a hundred small views
};

class ViewStoreContract : public ::testing::TestWithParam<ViewStoreFactory> {
 protected:
  const std::shared_ptr<ViewStore> store_ = GetParam().make();
  const Keyspace keyspace_ = test_keyspace();
};

TEST_P(ViewStoreContract, GivesNothingThatWasNotPut) {
  const std::vector<CellIndex> cells = test_cells(3);
  const std::vector<SharedView> found = store_->get(keyspace_, cells);
  ASSERT_EQ(found.size(), 3U);
  for (const SharedView& view : found) EXPECT_EQ(view, nullptr);
  EXPECT_EQ(store_->counters().misses, 3U);
  EXPECT_TRUE(store_->get(keyspace_, {}).empty());
}

TEST_P(ViewStoreContract, GivesBackEqualViewsInTheOrderAsked) {
  const std::vector<CellIndex> cells = test_cells(30);
  const std::vector<SharedView> views = test_views(30);
  store_->put(keyspace_, cells, views);
  const std::vector<CellIndex> asked = {cells[29], {100, 100}, cells[0], cells[29]};
  const std::vector<SharedView> found = store_->get(keyspace_, asked);
  ASSERT_EQ(found.size(), 4U);
  ASSERT_NE(found[0], nullptr);
  EXPECT_EQ(*found[0], *views[29]);
  EXPECT_EQ(found[1], nullptr);
  ASSERT_NE(found[2], nullptr);
  EXPECT_EQ(*found[2], *views[0]);
  ASSERT_NE(found[3], nullptr);
  EXPECT_EQ(*found[3], *views[29]);
  EXPECT_EQ(store_->counters().hits, 3U);
  EXPECT_EQ(store_->counters().stored, 30U);
}

TEST_P(ViewStoreContract, KeepsEveryPartOfTheKeyApart) {
  const std::vector<CellIndex> cell = {{1, 2}};
  store_->put(keyspace_, cell, test_views(1));
  std::vector<Keyspace> others(8, keyspace_);
  others[0].map.bytes[15] ^= 1U;
  others[1].engine = "tesu";
  others[2].engine_version = 4;
  others[3].profile.camera.columns = 240;
  others[4].profile.camera.rows = 13;
  others[5].profile.camera.elevation_min_rad = -0.25;
  others[6].profile.camera.elevation_max_rad = 0.25;
  others[7].profile.eye_height_m = 1.3;
  for (const Keyspace& other : others) EXPECT_EQ(store_->get(other, cell)[0], nullptr);
  EXPECT_EQ(store_->get(keyspace_, std::vector<CellIndex>{{2, 1}})[0], nullptr);
  EXPECT_NE(store_->get(keyspace_, cell)[0], nullptr);
}

TEST_P(ViewStoreContract, TakesTheSameViewTwice) {
  const std::vector<CellIndex> cells = test_cells(2);
  const std::vector<SharedView> views = test_views(2);
  store_->put(keyspace_, cells, views);
  store_->put(keyspace_, cells, views);
  EXPECT_EQ(*store_->get(keyspace_, cells)[1], *views[1]);
}

TEST_P(ViewStoreContract, ServesSeveralThreadsAtOnce) {
  const std::vector<CellIndex> cells = test_cells(40);
  const std::vector<SharedView> views = test_views(40);
  const auto work = [&](std::size_t first) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::size_t k = (first + i) % cells.size();
      store_->put(keyspace_, std::span(cells).subspan(k, 1), std::span(views).subspan(k, 1));
      const SharedView found = store_->get(keyspace_, std::span(cells).subspan(k, 1))[0];
      EXPECT_TRUE(found == nullptr || *found == *views[k]);
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t) threads.emplace_back(work, t * 10);
  for (std::thread& thread : threads) thread.join();
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const SharedView found = store_->get(keyspace_, std::span(cells).subspan(k, 1))[0];
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(*found, *views[k]);
  }
}

}  // namespace semview::cache
