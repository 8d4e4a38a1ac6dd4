// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/heat_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "similarity/fake_view_source.hpp"

namespace semview::similarity {
namespace {

class HeatMapTest : public testing::Test {
 protected:
  HeatMapTest() {
    Rng rng(3);
    const ClassTable observed = numbered_classes("seen", 4);
    const ClassTable map = numbered_classes("map", 3);
    const PanoramaCamera& camera = views_.profile().camera;
    prepared_ = PreparedObservation::build(random_observation(rng, camera, observed, 0, 90, 0.1),
                                           random_weights(rng, observed, map, 1, 1.0),
                                           map,
                                           camera)
                    .value();
    for (int iy = -3; iy < 4; ++iy) {
      for (int ix = -5; ix < 9; ++ix) {
        if ((ix + iy) % 3 != 0) cells_.push_back({ix, iy});
      }
    }
  }

  float expected(const CellIndex& cell, int headings) const {
    std::int32_t best = std::numeric_limits<std::int32_t>::min();
    for (int k = 0; k < 120; k += 120 / headings) {
      best = std::max(best, prepared_->sum(*views_.view(cell), k));
    }
    return static_cast<float>(prepared_->similarity(best));
  }

  FakeViewSource views_{3};
  std::optional<PreparedObservation> prepared_;
  std::vector<CellIndex> cells_;
  ThreadPool pool_{2};
};

TEST_F(HeatMapTest, HoldsTheBestHeadingOfEachCellAndNaNElsewhere) {
  for (const int headings : {120, 8, 1}) {
    const auto map = heat_map(*prepared_, views_, cells_, headings, pool_);
    ASSERT_TRUE(map);
    EXPECT_EQ(map->origin, (CellIndex{-5, -3}));
    for (int r = 0; r < map->similarity.rows(); ++r) {
      for (int c = 0; c < map->similarity.columns(); ++c) {
        const CellIndex cell{map->origin.ix + c, map->origin.iy + r};
        const bool asked = std::ranges::find(cells_, cell) != cells_.end();
        if (asked && views_.view(cell)) {
          EXPECT_EQ(map->similarity.at(r, c), expected(cell, headings));
          EXPECT_EQ(map->best_heading.at(r, c) % (120 / headings), 0);
        } else {
          EXPECT_TRUE(std::isnan(map->similarity.at(r, c)));
          EXPECT_EQ(map->best_heading.at(r, c), 255);
        }
      }
    }
  }
}

TEST_F(HeatMapTest, TheBestCellHasTheHighestSimilarity) {
  const auto map = heat_map(*prepared_, views_, cells_, 120, pool_);
  ASSERT_TRUE(map);
  const GridKey best = map->best();
  const float top = static_cast<float>(
      prepared_->similarity(prepared_->sum(*views_.view(best.cell), best.heading)));
  for (const float value : map->similarity.pixels()) EXPECT_FALSE(value > top);
}

TEST_F(HeatMapTest, RefusesHeadingsThatDoNotDivideTheCircleAndNoCells) {
  EXPECT_EQ(heat_map(*prepared_, views_, cells_, 7, pool_).error().field, "headings");
  EXPECT_EQ(heat_map(*prepared_, views_, cells_, 0, pool_).error().field, "headings");
  EXPECT_FALSE(heat_map(*prepared_, views_, {}, 120, pool_));
  const std::array<CellIndex, 2> far{CellIndex{-10000000, -10000000}, CellIndex{9999999, 9999999}};
  EXPECT_EQ(heat_map(*prepared_, views_, far, 120, pool_).error().code,
            ErrorCode::kInvalidArgument);
}

TEST_F(HeatMapTest, StopsWhenToldTo) {
  const auto map = heat_map(
      *prepared_, views_, cells_, 120, pool_, [](std::size_t, std::size_t) { return false; });
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace semview::similarity
