// SPDX-License-Identifier: Apache-2.0
#include "semview/simulation/world.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "simulation/two_rooms.hpp"

namespace semview::simulation {
namespace {

World vary(std::uint64_t seed, double height_error_m, double missing_share) {
  Rng rng(seed, "layout");
  return vary_plan(two_rooms(), {height_error_m, missing_share}, rng);
}

const ColumnProfile& table(const World& world) { return world.plan.profile(5, 6); }

TEST(WorldTest, WithoutErrorsTheWorldIsAsDrawn) {
  const World world = vary(1, 0.0, 0.0);
  const map::SemanticMap drawn = two_rooms();
  for (int row = 0; row < world.plan.rows(); ++row) {
    for (int column = 0; column < world.plan.columns(); ++column) {
      ASSERT_EQ(world.plan.profile(row, column), drawn.columns()->profile(row, column));
    }
  }
  EXPECT_EQ(world.objects, 6);    // a door, a table, four chairs
  EXPECT_EQ(world.furniture, 5);  // all but the door
  EXPECT_EQ(world.missing, 0);
}

TEST(WorldTest, ObjectsStandWithinTheErrorOfTheirDrawnHeightAndWallsStay) {
  bool moved = false;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const World world = vary(seed, 0.05, 0.0);
    ASSERT_EQ(table(world).slabs.size(), 1U);
    const Slab top = table(world).slabs[0];
    EXPECT_LE(std::abs(top.z_min_m - 0.70), 0.05 + 1e-12);
    EXPECT_NEAR(top.z_max_m - top.z_min_m, 0.05, 1e-12);
    moved = moved || top.z_min_m != 0.70;
    EXPECT_EQ(world.plan.profile(0, 0).slabs, (std::vector<Slab>{{0.0, 2.6, 3}}));
    const std::vector<Slab> door = world.plan.profile(20, 41).slabs;
    ASSERT_EQ(door.size(), 2U);
    EXPECT_EQ(door[0].z_min_m, 0.0);
    EXPECT_EQ(door[0].z_max_m, door[1].z_min_m);
    EXPECT_EQ(door[1].z_max_m, 2.6);
    EXPECT_TRUE(world.plan.profile(20, 41).passable);
  }
  EXPECT_TRUE(moved);
}

TEST(WorldTest, MissingFurnitureLeavesTheFloorAndFollowsItsProbability) {
  EXPECT_EQ(vary(3, 0.0, 1.0).missing, 5);
  EXPECT_TRUE(table(vary(3, 0.0, 1.0)).slabs.empty());
  EXPECT_EQ(table(vary(3, 0.0, 1.0)).ground, 2);
  int missing = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) missing += vary(seed, 0.05, 0.2).missing;
  // 1000 draws of 0.2: standard deviation 12.6; five of them.
  EXPECT_NEAR(missing, 200, 63);
}

TEST(WorldTest, DoorsOnTheWayAreOpenedOthersStayShut) {
  map::ColumnMap plan = *two_rooms().columns();
  const std::vector<Point2> elsewhere{{1.0, 2.1}, {2.0, 2.1}};
  EXPECT_EQ(open_doors(plan, elsewhere, 0.35, 1.2), 0);
  EXPECT_EQ(plan.profile(20, 41).slabs.size(), 2U);
  const std::vector<Point2> through{{3.5, 2.1}, {4.15, 2.1}, {5.0, 2.1}};
  EXPECT_EQ(open_doors(plan, through, 0.35, 1.2), 1);
  EXPECT_EQ(plan.profile(20, 41).slabs, (std::vector<Slab>{{2.1, 2.6, 3}}));  // the lintel stays
}

}  // namespace
}  // namespace semview::simulation
