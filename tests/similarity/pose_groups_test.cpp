// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/pose_groups.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/core/random.hpp"

namespace semview::similarity {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<Pose2> poses_within(double reach_m, std::size_t count) {
  Rng rng(3);
  std::vector<Pose2> poses;
  for (std::size_t i = 0; i < count; ++i) {
    poses.push_back(
        {rng.uniform(-reach_m, reach_m), rng.uniform(-reach_m, reach_m), rng.uniform(-kPi, kPi)});
  }
  return poses;
}

/// Pose indices as a comparison of cells, headings and indices orders them.
std::vector<std::uint32_t> literal_order(const std::vector<Pose2>& poses, HeadingMode mode) {
  std::vector<std::uint32_t> order(poses.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto rank = [&](std::uint32_t i) {
    const GridKey key = PoseGrid::key(poses[i]).value();
    return std::tuple(key.cell, mode == HeadingMode::kAsGiven ? key.heading : 0, i);
  };
  std::ranges::sort(order, [&](std::uint32_t l, std::uint32_t r) { return rank(l) < rank(r); });
  return order;
}

TEST(PoseGroupsTest, TheOrderIsThatOfComparingCellsHeadingsAndPlaces) {
  for (const HeadingMode mode : {HeadingMode::kAsGiven, HeadingMode::kCompass}) {
    // Few and many, crowded and as far apart as the grid goes.
    for (const std::size_t count : {std::size_t{1}, std::size_t{60}, std::size_t{3000}}) {
      for (const double reach_m : {0.2, 5.0, 300.0, PoseGrid::kMaxCoordinate_m}) {
        const std::vector<Pose2> poses = poses_within(reach_m, count);
        const auto groups = group_by_cell(poses, mode);
        ASSERT_TRUE(groups);
        EXPECT_EQ(groups->order, literal_order(poses, mode)) << count << " within " << reach_m;
      }
    }
  }
}

TEST(PoseGroupsTest, EachCellStandsOnceAndHasItsPoses) {
  const std::vector<Pose2> poses = poses_within(2.0, 2000);
  const auto groups = group_by_cell(poses, HeadingMode::kAsGiven);
  ASSERT_TRUE(groups);
  EXPECT_TRUE(std::ranges::is_sorted(groups->cells));
  EXPECT_EQ(std::ranges::adjacent_find(groups->cells), groups->cells.end());
  ASSERT_EQ(groups->begins.size(), groups->cells.size() + 1);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < groups->cells.size(); ++i) {
    EXPECT_FALSE(groups->poses_of(i).empty());
    for (const std::uint32_t pose : groups->poses_of(i)) {
      EXPECT_EQ(PoseGrid::key(poses[pose])->cell, groups->cells[i]);
      EXPECT_EQ(PoseGrid::key(poses[pose])->heading, groups->headings[pose]);
      ++seen;
    }
  }
  EXPECT_EQ(seen, poses.size());
}

TEST(PoseGroupsTest, PosesOfCellsWithOneViewAreTogether) {
  const std::vector<Pose2> poses = {{0.25, 0.05, 0.0}, {0.05, 0.05, 0.0}, {0.15, 0.05, 0.0}};
  const auto groups = group_by_cell(poses, HeadingMode::kCompass, [](const CellIndex& cell) {
    return cell == CellIndex{2, 0} ? CellIndex{0, 0} : cell;
  });
  ASSERT_TRUE(groups);
  EXPECT_THAT(groups->cells, ElementsAre(CellIndex{0, 0}, CellIndex{1, 0}));
  EXPECT_THAT(groups->poses_of(0), ElementsAre(0U, 1U));
  EXPECT_THAT(groups->poses_of(1), ElementsAre(2U));
}

TEST(PoseGroupsTest, OfNoPosesThereAreNoGroups) {
  const auto groups = group_by_cell({}, HeadingMode::kAsGiven);
  ASSERT_TRUE(groups);
  EXPECT_TRUE(groups->cells.empty());
  EXPECT_THAT(groups->begins, ElementsAre(0U));
}

TEST(PoseGroupsTest, APoseOffTheGridIsNamedWithEitherMode) {
  for (const HeadingMode mode : {HeadingMode::kAsGiven, HeadingMode::kCompass}) {
    for (const Pose2& bad : {Pose2{2e6, 0.0, 0.0},
                             Pose2{0.0, std::numeric_limits<double>::quiet_NaN(), 0.0},
                             Pose2{0.0, 0.0, std::numeric_limits<double>::infinity()}}) {
      std::vector<Pose2> poses = poses_within(1.0, 9);
      poses[5] = bad;
      const auto groups = group_by_cell(poses, mode);
      ASSERT_FALSE(groups);
      EXPECT_EQ(groups.error().code, ErrorCode::kInvalidArgument);
      EXPECT_EQ(groups.error().field, "poses");
      EXPECT_THAT(groups.error().message, HasSubstr("pose 5"));
    }
  }
}

}  // namespace
}  // namespace semview::similarity
