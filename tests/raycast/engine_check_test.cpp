// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/engine_check.hpp"

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "mesh/text_plan.hpp"
#include "raycast/small_worlds.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/columns_engine.hpp"
#include "semview/raycast/embree_engine.hpp"
#include "support/paths.hpp"

namespace semview::raycast {
namespace {

constexpr double kEye_m = 1.2;

/// Two rooms of 3 m × 2 m with a door between them and a table in the right one, 10 cm a pixel.
map::ColumnMap two_rooms() {
  std::vector<std::string> rows(20, "#" + std::string(30, '.') + "#" + std::string(30, '.') + "#");
  rows.insert(rows.begin(), std::string(63, '#'));
  rows.emplace_back(63, '#');
  for (const std::size_t row : {8U, 9U, 10U, 11U, 12U}) rows[row][31] = 'd';
  rows[10][45] = 't';
  return map::plan_from_text(
      rows,
      {{'.', {.ground = 1, .slabs = {}}},
       {'#', {.ground = 1, .slabs = {{0.0, 2.6, 2}}}},
       {'d', {.passable = true, .ground = 1, .slabs = {{0.0, 2.1, 3}, {2.1, 2.6, 2}}}},
       {'t', {.ground = 1, .slabs = {{0.7, 0.75, 4}}}}},
      0.1);
}

TEST(CellsToCheckTest, AreInEveryRoomAndNearEveryPairOfNeighbours) {
  const map::ColumnMap plan = two_rooms();
  const map::CellGrid grid = map::build_cell_grid(plan, kEye_m);
  const std::vector<CellIndex> cells = cells_to_check(plan, grid);
  EXPECT_GE(cells.size(), kCheckedCells);
  EXPECT_EQ(std::set<CellIndex>(cells.begin(), cells.end()).size(), cells.size());
  EXPECT_TRUE(std::ranges::is_sorted(cells));
  const auto any_within = [&](double x0_m, double x1_m, double y0_m, double y1_m) {
    return std::ranges::any_of(cells, [&](const CellIndex& cell) {
      const Pose2 center = PoseGrid::center(cell);
      return center.x_m > x0_m && center.x_m < x1_m && center.y_m > y0_m && center.y_m < y1_m;
    });
  };
  for (const CellIndex& cell : cells) EXPECT_TRUE(grid.has_eye(cell));
  EXPECT_TRUE(any_within(0.1, 3.1, 0.1, 2.1)) << "left room";
  EXPECT_TRUE(any_within(3.2, 6.2, 0.1, 2.1)) << "right room";
  EXPECT_TRUE(any_within(2.6, 3.7, 0.4, 1.9)) << "door and wall";
  EXPECT_TRUE(any_within(4.0, 5.1, 0.6, 1.7)) << "table and floor";
}

TEST(CellsToCheckTest, AMapWithoutAnEyeHasNone) {
  const map::ColumnMap plan = two_rooms();
  map::ColumnMap low = plan;
  low.ceiling = map::Ceiling{5, 1.0};
  EXPECT_TRUE(cells_to_check(low, map::build_cell_grid(low, kEye_m)).empty());
}

class FindDisagreementTest : public ::testing::Test {
 protected:
  std::optional<Disagreement> find(const map::ColumnMap& columns, const map::ColumnMap& mesh) {
    const auto scene = std::make_shared<const Scene>(*Scene::build(map::extrude(mesh)));
    const auto walks = std::make_shared<const ColumnScene>(ColumnScene::build(columns));
    const map::CellGrid grid = map::build_cell_grid(mesh, kEye_m);
    return find_disagreement(ColumnsEngine(walks),
                             EmbreeEngine(scene),
                             cells_to_check(mesh, grid),
                             {},
                             mesh.ground_height_m,
                             pool_);
  }
  ThreadPool pool_{2};
};

TEST_F(FindDisagreementTest, FindsNoneOnTheShippedPlans) {
  for (const char* name : {"duplex_level1", "duplex_level2", "largebuilding_level1", "tutorial"}) {
    const auto map = map::load_map(std::string(SEMVIEW_SOURCE_DIR "/maps/") + name);
    ASSERT_TRUE(map);
    EXPECT_FALSE(find(*map->columns(), *map->columns())) << name;
  }
}

TEST_F(FindDisagreementTest, FindsNoneOnRandomPlans) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng(seed, "check");
    const map::ColumnMap plan = random_plan(rng, 13, 17);
    const auto found = find(plan, plan);
    EXPECT_FALSE(found) << seed << ": row " << found->row << ", column " << found->column;
  }
}

TEST_F(FindDisagreementTest, FindsAnotherClass) {
  const map::ColumnMap plan = two_rooms();
  map::ColumnMap other = plan;
  other.profiles[other.profile_of_pixel.at(10, 45)].slabs[0].label = 7;
  const auto found = find(other, plan);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->seen, 7);
  EXPECT_EQ(found->expected, 4);
}

TEST_F(FindDisagreementTest, FindsAnotherRangeOfTheSameClass) {
  const map::ColumnMap plan = two_rooms();
  map::ColumnMap other = plan;
  other.origin.x_m += 0.02;  // everything, seen 2 cm off
  const auto found = find(other, plan);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->seen, found->expected);
  EXPECT_GT(std::abs(found->seen_range_m - found->expected_range_m), 0.01F);
}

/// Columns whose runs have the planes of a world 5 cm aside.
class BentPlanes final : public Engine {
 public:
  BentPlanes(const ColumnsEngine& right, const ColumnsEngine& aside)
      : right_(right), aside_(aside) {}
  std::string_view name() const override { return "bent"; }
  std::uint32_t version() const override { return 1; }
  Panorama panorama(const PanoramaRequest& request) const override {
    return right_.panorama(request);
  }
  ColumnView column_view(const PanoramaRequest& request, bool ranges) const override {
    return (ranges ? aside_ : right_).column_view(request, ranges);
  }

 private:
  const ColumnsEngine& right_;
  const ColumnsEngine& aside_;
};

TEST_F(FindDisagreementTest, FindsAnotherRangeInTheRunsAlone) {
  const map::ColumnMap plan = two_rooms();
  map::ColumnMap moved = plan;
  moved.origin.x_m += 0.05;
  const ColumnsEngine right(std::make_shared<const ColumnScene>(ColumnScene::build(plan)));
  const ColumnsEngine aside(std::make_shared<const ColumnScene>(ColumnScene::build(moved)));
  const EmbreeEngine embree(std::make_shared<const Scene>(*Scene::build(map::extrude(plan))));
  const std::vector<CellIndex> cells = cells_to_check(plan, map::build_cell_grid(plan, kEye_m));
  EXPECT_FALSE(find_disagreement(right, embree, cells, {}, plan.ground_height_m, pool_));
  EXPECT_TRUE(
      find_disagreement(BentPlanes(right, aside), embree, cells, {}, plan.ground_height_m, pool_));
}

}  // namespace
}  // namespace semview::raycast
