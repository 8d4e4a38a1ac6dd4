// SPDX-License-Identifier: Apache-2.0
#include "semview/simulation/indoors.hpp"

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mesh/text_plan.hpp"
#include "semview/raycast/columns_engine.hpp"

namespace semview::simulation {
namespace {

constexpr double kEye_m = 1.2;

/// A room of 4 m × 3 m with a door to a terrace of 4 m × 2 m, 10 cm a pixel; row 0 is the far end
/// of the terrace.
map::ColumnMap room_with_terrace() {
  std::vector<std::string> rows(20, std::string(42, '.'));
  std::string front(42, '#');
  front.replace(10, 9, "ddddddddd");
  rows.push_back(front);
  rows.insert(rows.end(), 30, "#" + std::string(40, '.') + "#");
  rows.emplace_back(42, '#');
  return map::plan_from_text(
      rows,
      {{'.', {.ground = 1, .slabs = {}}},
       {'#', {.ground = 1, .slabs = {{0.0, 2.6, 2}}}},
       {'d', {.passable = true, .ground = 1, .slabs = {{0.0, 2.1, 3}, {2.1, 2.6, 2}}}}},
      0.1);
}

map::CellGrid indoors(const map::ColumnMap& plan) {
  const raycast::ColumnsEngine engine(
      std::make_shared<const raycast::ColumnScene>(raycast::ColumnScene::build(plan)));
  return indoor_cells(map::build_cell_grid(plan, kEye_m), engine, plan.ground_height_m + kEye_m);
}

TEST(IndoorsTest, TheTerraceIsLeftOutAndTheRoomWithItsDoorStays) {
  const map::ColumnMap plan = room_with_terrace();
  const map::CellGrid all = map::build_cell_grid(plan, kEye_m);
  const map::CellGrid grid = indoors(plan);
  const CellIndex room = *PoseGrid::cell(2.05, 1.55);
  const CellIndex door = *PoseGrid::cell(1.45, 3.15);
  const CellIndex terrace = *PoseGrid::cell(2.05, 4.55);
  ASSERT_TRUE(all.is_free(room) && all.is_free(door) && all.is_free(terrace));
  EXPECT_TRUE(grid.is_free(room));
  EXPECT_TRUE(grid.is_free(door));
  EXPECT_FALSE(grid.is_free(terrace));
  EXPECT_EQ(grid.free_count(), 40U * 30U + 9U);
  EXPECT_TRUE(grid.can_step(room, {room.ix + 1, room.iy}));
}

TEST(IndoorsTest, APlanWithoutOuterWallsKeepsAllItsFreeCells) {
  const std::vector<std::string> rows(30, std::string(10, '.') + "#" + std::string(19, '.'));
  const map::ColumnMap plan = map::plan_from_text(
      rows,
      {{'.', {.ground = 1, .slabs = {}}}, {'#', {.ground = 1, .slabs = {{0.0, 2.6, 2}}}}},
      0.1);
  EXPECT_EQ(indoors(plan).free_count(), map::build_cell_grid(plan, kEye_m).free_count());
}

}  // namespace
}  // namespace semview::simulation
