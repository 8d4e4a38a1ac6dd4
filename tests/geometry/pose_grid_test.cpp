// SPDX-License-Identifier: Apache-2.0
#include "semview/geometry/pose_grid.hpp"

#include <limits>
#include <set>
#include <unordered_set>

#include <gtest/gtest.h>

namespace semview {
namespace {

TEST(PoseGridTest, TheCellAtTheOriginBeginsThere) {
  EXPECT_EQ(PoseGrid::cell(0.0, 0.0), (CellIndex{0, 0}));
  EXPECT_EQ(PoseGrid::cell(0.0999, 0.05), (CellIndex{0, 0}));
}

TEST(PoseGridTest, NegativeCoordinatesRoundDownNotTowardsZero) {
  EXPECT_EQ(PoseGrid::cell(-0.0001, -0.0001), (CellIndex{-1, -1}));
  EXPECT_EQ(PoseGrid::cell(-0.15, 0.15), (CellIndex{-2, 1}));
}

TEST(PoseGridTest, LowerAndLeftEdgesBelongToTheCell) {
  for (int i = -50; i <= 50; ++i) {
    // i / 10.0 is the double nearest to the edge, as a user would type it.
    EXPECT_EQ(PoseGrid::cell(i / 10.0, i / 10.0), (CellIndex{i, i}));
  }
}

TEST(PoseGridTest, PositionsThatAreNoPlaceHaveNoCell) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(PoseGrid::cell(kNan, 0.0));
  EXPECT_FALSE(PoseGrid::cell(0.0, kInf));
  EXPECT_FALSE(PoseGrid::cell(-1.1e6, 0.0));
  EXPECT_TRUE(PoseGrid::cell(1.0e6, -1.0e6));
  EXPECT_FALSE(PoseGrid::key({0.0, 0.0, kNan}));
}

TEST(PoseGridTest, HeadingsGoCounterClockwiseFromAhead) {
  EXPECT_EQ(PoseGrid::heading(0.0), 0);
  EXPECT_EQ(PoseGrid::heading(rad_from_deg(3.0)), 1);
  EXPECT_EQ(PoseGrid::heading(kPi / 2.0), 30);
  EXPECT_EQ(PoseGrid::heading(-kPi / 2.0), 90);
  EXPECT_EQ(PoseGrid::heading(rad_from_deg(-3.0)), 119);
}

TEST(PoseGridTest, BothSidesOfHalfATurnMeet) {
  EXPECT_EQ(PoseGrid::heading(kPi), 60);
  EXPECT_EQ(PoseGrid::heading(-kPi), 60);
  EXPECT_EQ(PoseGrid::heading(kPi - 0.01), 60);
  EXPECT_EQ(PoseGrid::heading(-kPi + 0.01), 60);
}

TEST(PoseGridTest, ATieTakesTheCounterClockwiseHeading) {
  // 1.5° and -1.5° lie half-way; both quotients by 3° are exact in doubles.
  EXPECT_EQ(PoseGrid::heading(kTwoPi / 240.0), 1);
  EXPECT_EQ(PoseGrid::heading(-kTwoPi / 240.0), 0);
}

TEST(PoseGridTest, AHeadingIsAShiftOfColumns) {
  // view_k[c] = view_0[(c - k·W/120) mod W]
  EXPECT_EQ(PoseGrid::source_column(10, 0, 360), 10);
  EXPECT_EQ(PoseGrid::source_column(10, 1, 360), 7);
  EXPECT_EQ(PoseGrid::source_column(1, 1, 360), 358);
  for (const int columns : {120, 360, 720}) {
    for (int k = 0; k < PoseGrid::kHeadings; ++k) {
      std::set<int> sources;
      for (int c = 0; c < columns; ++c) sources.insert(PoseGrid::source_column(c, k, columns));
      EXPECT_EQ(static_cast<int>(sources.size()), columns);
      EXPECT_EQ(*sources.begin(), 0);
      EXPECT_EQ(*sources.rbegin(), columns - 1);
    }
  }
}

TEST(CellIndexTest, OrdersRowByRow) {
  EXPECT_LT((CellIndex{9, -1}), (CellIndex{-9, 0}));
  EXPECT_LT((CellIndex{-9, 0}), (CellIndex{9, 0}));
}

TEST(CellIndexTest, NeighboursDoNotShareAHash) {
  std::unordered_set<std::size_t> hashes;
  for (int x = -40; x < 40; ++x) {
    for (int y = -40; y < 40; ++y) hashes.insert(std::hash<CellIndex>{}({x, y}));
  }
  EXPECT_EQ(hashes.size(), 6400U);
}

}  // namespace
}  // namespace semview
