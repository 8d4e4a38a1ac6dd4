// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/heat_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "semview/similarity/similarity_score_source.hpp"
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
    const Observation observation = random_observation(rng, camera, observed, 0, 90, 0.1);
    const WeightMatrix weights = random_weights(rng, observed, map, 1, 1.0);
    prepared_ = PreparedObservation::build(observation, weights, map, camera).value();
    source_ = std::make_unique<SimilarityScoreSource>(views_, map, weights, pool_);
    EXPECT_TRUE(source_->set_observation(observation));
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
  std::unique_ptr<SimilarityScoreSource> source_;
};

template <typename Value>
void expect_equal(const Image<Value>& a, const Image<Value>& b) {
  ASSERT_EQ(a.pixels().size(), b.pixels().size());
  const auto same = [](Value x, Value y) { return x == y || (x != x && y != y); };
  EXPECT_TRUE(std::ranges::equal(a.pixels(), b.pixels(), same));
}

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

TEST_F(HeatMapTest, ASourceOfScoresGivesTheSame) {
  const CellWeight weight = [](std::span<const double, PoseGrid::kHeadings> similarities) {
    return similarities[0] + 2.0 * similarities[119];
  };
  for (const auto& [headings, cell_weight] : {std::pair(120, weight),
                                              std::pair(24, weight),
                                              std::pair(24, CellWeight()),
                                              std::pair(1, CellWeight())}) {
    const auto swept = heat_map(*prepared_, views_, cells_, headings, pool_, {}, cell_weight);
    const auto asked = heat_map(*source_, cells_, even_headings(headings), {}, cell_weight);
    ASSERT_TRUE(swept && asked);
    EXPECT_EQ(asked->origin, swept->origin);
    expect_equal(asked->similarity, swept->similarity);
    expect_equal(asked->best_heading, swept->best_heading);
    expect_equal(asked->log_weight, swept->log_weight);
  }
}

TEST_F(HeatMapTest, ASourceIsAskedAboutHeadingsOfTheGridAlone) {
  for (const std::vector<int>& headings : {std::vector<int>{}, {120}, {-1}, {3, 3}, {4, 3}}) {
    EXPECT_EQ(heat_map(*source_, cells_, headings).error().field, "headings");
  }
  EXPECT_FALSE(heat_map(*source_, {}, even_headings(120)));
  const auto stopped =
      heat_map(*source_, cells_, even_headings(2), [](std::size_t, std::size_t) { return false; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
}

TEST(EvenHeadingsTest, AreTheNearestOfTheGrid) {
  EXPECT_EQ(even_headings(1), std::vector{0});
  EXPECT_EQ(even_headings(4), (std::vector{0, 30, 60, 90}));
  EXPECT_EQ(even_headings(16),
            (std::vector{0, 8, 15, 23, 30, 38, 45, 53, 60, 68, 75, 83, 90, 98, 105, 113}));
  EXPECT_EQ(even_headings(120).back(), 119);
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
