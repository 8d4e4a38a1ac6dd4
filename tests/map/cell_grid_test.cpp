// SPDX-License-Identifier: Apache-2.0
#include "semview/map/cell_grid.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/bundle.hpp"
#include "semview/core/random.hpp"

namespace semview::map {
namespace {

using testing::columns;
using ::testing::ElementsAre;

constexpr double kEye_m = 1.2;
constexpr std::uint8_t kEye = CellGrid::kHasEye;

TEST(CellGridTest, FreeIsInsideAndWithoutObstacleBelowTheEye) {
  // One pixel a cell; row 0 of the drawing is iy 1.
  const CellGrid grid = build_cell_grid(columns({".#t D", "....."}), kEye_m);
  EXPECT_TRUE(grid.is_free({0, 1}));
  EXPECT_FALSE(grid.is_free({1, 1})) << "wall";
  EXPECT_FALSE(grid.is_free({2, 1})) << "table";
  EXPECT_FALSE(grid.is_free({3, 1})) << "outside";
  EXPECT_TRUE(grid.is_free({4, 1})) << "a door is passable";
  EXPECT_FALSE(grid.is_free({5, 0})) << "past the image";
  EXPECT_EQ(grid.free_count(), 7U);
}

TEST(CellGridTest, AnEyeLowerThanTheTablePassesUnderIt) {
  const CellGrid grid = build_cell_grid(columns({".t."}), 0.6);
  EXPECT_TRUE(grid.is_free({1, 0}));
  EXPECT_TRUE(grid.has_eye({1, 0}));
}

TEST(CellGridTest, AnEyeOverATableSeesAlthoughNoRobotStandsThere) {
  const CellGrid grid = build_cell_grid(columns({".t."}), kEye_m);
  EXPECT_FALSE(grid.is_free({1, 0}));
  EXPECT_TRUE(grid.has_eye({1, 0}));
}

TEST(CellGridTest, ThresholdsLowerThanFiveCentimetresDoNotBlock) {
  ColumnMap map = columns({".t."});
  map.profiles[4].slabs = {{0.0, 0.05, 4}};
  EXPECT_TRUE(build_cell_grid(map, kEye_m).is_free({1, 0}));
  map.profiles[4].slabs = {{0.0, 0.06, 4}};
  EXPECT_FALSE(build_cell_grid(map, kEye_m).is_free({1, 0}));
}

TEST(CellGridTest, NoEyeInsideADoorAWallOutsideOrAboveTheCeiling) {
  const CellGrid grid = build_cell_grid(columns({"D# ."}), kEye_m);
  EXPECT_FALSE(grid.has_eye({0, 0}));
  EXPECT_FALSE(grid.has_eye({1, 0}));
  EXPECT_FALSE(grid.has_eye({2, 0}));
  EXPECT_TRUE(grid.has_eye({3, 0}));
  EXPECT_FALSE(build_cell_grid(columns({"...."}), 2.7).has_eye({1, 0}));
}

TEST(CellGridTest, AnEyeOnAWallsFaceHasNoView) {
  // 5 cm pixels: the cells' centres lie on pixel corners.
  const CellGrid grid = build_cell_grid(columns({"#...", "#..."}, 0.05, {-0.05, 0.0, 0.0}), kEye_m);
  // Centre (0.05, 0.05) touches only floor; with the image shifted by one pixel it touches a wall.
  EXPECT_TRUE(grid.has_eye({0, 0}));
  const CellGrid touching = build_cell_grid(columns({"#...", "#..."}, 0.05), kEye_m);
  EXPECT_TRUE(touching.is_free({0, 0})) << "the pixel right of and above the point is floor";
  EXPECT_FALSE(touching.has_eye({0, 0}));
}

TEST(CellGridTest, ViewOfACellWithAnEyeIsItsOwn) {
  const CellGrid grid({0, 0}, 2, 1, {kEye, kEye});
  EXPECT_EQ(grid.view_cell({1, 0}), (CellIndex{1, 0}));
}

TEST(CellGridTest, ViewTiesGoToTheLowestIyThenIx) {
  // All four neighbours see, the middle does not.
  const CellGrid cross({-1, -1}, 3, 3, {0, kEye, 0, kEye, 0, kEye, 0, kEye, 0});
  EXPECT_EQ(cross.view_cell({0, 0}), (CellIndex{0, -1}));
  const CellGrid sides({-1, 0}, 3, 1, {kEye, 0, kEye});
  EXPECT_EQ(sides.view_cell({0, 0}), (CellIndex{-1, 0}));
  // Nearer beats lower.
  const CellGrid corner({0, 0}, 2, 3, {0, kEye, 0, 0, kEye, 0});
  EXPECT_EQ(corner.view_cell({0, 1}), (CellIndex{0, 2}));
}

TEST(CellGridTest, ViewReachesHalfAMetreAndNoFarther) {
  const CellGrid grid({0, 0}, 1, 1, {kEye});
  EXPECT_EQ(grid.view_cell({5, 0}), (CellIndex{0, 0}));
  EXPECT_EQ(grid.view_cell({3, -4}), (CellIndex{0, 0}));
  EXPECT_FALSE(grid.view_cell({4, 4}));
  EXPECT_FALSE(grid.view_cell({6, 0}));
  EXPECT_FALSE(grid.view_cell({2'000'000'000, 2'000'000'000}));
}

TEST(CellGridTest, ViewCellIsTheBruteForceMinimum) {
  Rng rng(7, "cells");
  std::vector<std::uint8_t> facts(400);
  for (std::uint8_t& fact : facts) fact = rng.uniform() < 0.03 ? kEye : 0;
  const CellGrid grid({-8, -11}, 20, 20, facts);
  for (int iy = -17; iy < 15; ++iy) {
    for (int ix = -14; ix < 18; ++ix) {
      std::optional<CellIndex> best;
      int best_squared = 26;
      for (int y = -11; y < 9; ++y) {
        for (int x = -8; x < 12; ++x) {
          const int squared = (x - ix) * (x - ix) + (y - iy) * (y - iy);
          if (grid.has_eye({x, y}) && squared < best_squared) {
            best = CellIndex{x, y};
            best_squared = squared;
          }
        }
      }
      ASSERT_EQ(grid.view_cell({ix, iy}), best) << ix << " " << iy;
    }
  }
}

TEST(CellGridTest, FreeCellsComeRowByRowFromTheLowest) {
  const CellGrid grid = build_cell_grid(columns({".#", "#."}, 0.1, {-0.1, 0.2, 0.0}), kEye_m);
  EXPECT_THAT(grid.free_cells(), ElementsAre(CellIndex{0, 2}, CellIndex{-1, 3}));
}

TEST(CellGridTest, DoorsJoinRoomsAndWallsPartThem) {
  const CellGrid closed = build_cell_grid(columns({"..#..", "..#.."}), kEye_m);
  const std::vector<GridComponent> parts = closed.components();
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].cells, 4U);
  EXPECT_EQ(parts[0].first, (CellIndex{0, 0}));
  EXPECT_EQ(parts[1].first, (CellIndex{3, 0}));
  EXPECT_EQ(closed.reachable_from({3, 1}).size(), 4U);
  EXPECT_TRUE(closed.reachable_from({2, 0}).empty()) << "a wall";

  const CellGrid joined = build_cell_grid(columns({"..#..", "..D.."}), kEye_m);
  EXPECT_EQ(joined.components().size(), 1U);
  EXPECT_EQ(joined.reachable_from({0, 0}), joined.free_cells());
}

TEST(CellGridTest, AWallThinnerThanACellStillParts) {
  // 2 cm pixels: the wall lies between the centres of two cells, under neither.
  std::vector<std::string> rows(10, ".........#..........");
  const CellGrid grid = build_cell_grid(columns(rows, 0.02), kEye_m);
  EXPECT_TRUE(grid.is_free({1, 0}));
  EXPECT_TRUE(grid.is_free({2, 0}));
  EXPECT_FALSE(grid.can_step({1, 0}, {2, 0}));
  EXPECT_FALSE(grid.can_step({2, 0}, {1, 0}));
  EXPECT_TRUE(grid.can_step({1, 0}, {0, 0}));
  EXPECT_FALSE(grid.can_step({0, 0}, {2, 0})) << "not neighbours";
  EXPECT_EQ(grid.components().size(), 2U);
}

TEST(CellGridTest, ATurnedImageIsCoveredByAnUnturnedGrid) {
  const ColumnMap map =
      columns(std::vector<std::string>(20, std::string(40, '.')), 0.1, {1.0, 1.0, 0.5});
  const CellGrid grid = build_cell_grid(map, kEye_m);
  for (const CellIndex& cell : grid.free_cells()) {
    const Pose2 center = PoseGrid::center(cell);
    ASSERT_NE(map.at(center.x_m, center.y_m), nullptr);
  }
  // The area in cells, up to the border's cells.
  EXPECT_NEAR(static_cast<double>(grid.free_count()), 800.0, 60.0);
}

}  // namespace
}  // namespace semview::map
