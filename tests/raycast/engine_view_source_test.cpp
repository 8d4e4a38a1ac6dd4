// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/engine_view_source.hpp"

#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "raycast/small_worlds.hpp"
#include "semview/raycast/embree_engine.hpp"

namespace semview::raycast {
namespace {

std::shared_ptr<const Engine> room() {
  return std::make_shared<const EmbreeEngine>(std::make_shared<const Scene>(
      std::move(*Scene::build(box_room({-1.5F, -2.25F, 0.5F}, {4.0F, 3.5F, 3.25F})))));
}

constexpr double kGround_m = 0.5;

TEST(EngineViewSourceTest, CastsEachCellFromItsCentreAtYawZero) {
  ThreadPool pool(1);
  const auto engine = room();
  const auto source = EngineViewSource::create(engine, {}, kGround_m, pool);
  ASSERT_TRUE(source);
  const std::vector<CellIndex> cells{{0, 0}, {-7, 12}, {0, 0}};
  const auto batch = (*source)->views(cells);
  ASSERT_TRUE(batch);
  ASSERT_EQ(batch->views.size(), 3U);
  EXPECT_EQ(batch->origins, (ViewOrigins{0, 0, 3}));
  EXPECT_EQ(*batch->views[0], *batch->views[2]);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const PanoramaRequest request{PoseGrid::center(cells[i]), kGround_m + 1.2, {}, {}};
    EXPECT_EQ(*batch->views[i], engine->column_view(request, false));
  }
}

TEST(EngineViewSourceTest, ThreadsChangeNothing) {
  std::vector<CellIndex> cells;
  for (int i = 0; i < 64; ++i) cells.push_back({i % 8, i / 8});
  ThreadPool alone(1);
  ThreadPool several(4);
  const auto engine = room();
  const auto one = EngineViewSource::create(engine, {}, kGround_m, alone);
  const auto many = EngineViewSource::create(engine, {}, kGround_m, several);
  const auto truth = (*one)->views(cells);
  std::vector<std::jthread> callers;
  for (int caller = 0; caller < 3; ++caller) {
    callers.emplace_back([&] {
      const auto batch = (*many)->views(cells);
      ASSERT_TRUE(batch);
      for (std::size_t i = 0; i < cells.size(); ++i) {
        EXPECT_EQ(*batch->views[i], *truth->views[i]);
      }
    });
  }
}

TEST(EngineViewSourceTest, RefusesAProfileOutsideTheLimits) {
  ThreadPool pool(1);
  const auto source = EngineViewSource::create(room(), {{361, 90, -0.7, 0.7}, 1.2}, 0.0, pool);
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().field, "columns");
}

}  // namespace
}  // namespace semview::raycast
