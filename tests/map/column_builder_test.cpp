// SPDX-License-Identifier: Apache-2.0
#include "semview/map/column_builder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semview::map::detail {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr ClassId kFloor = 1;
constexpr ClassId kWall = 2;
constexpr ClassId kOwn = 3;

/// Floor, a wall of 0.1 to 2.5 m, and one class of the test's choice, in a storey of 0 to 2.6 m.
ColumnProfile profile_of(MapClass own, Storey storey = {0.0, kFloor, Ceiling{4, 2.6}}) {
  MapClass floor;
  floor.name = "floor";
  MapClass wall;
  wall.name = "wall";
  wall.min_height_m = 0.1;
  wall.max_height_m = 2.5;
  own.name = "own";
  const std::vector<MapClass> classes{floor, wall, own};
  return column_profile(classes, ClassTable({"floor", "wall", "own"}), kOwn, storey);
}

MapClass heights(double low_m, double high_m, std::string below = "", std::string above = "") {
  MapClass value;
  value.min_height_m = low_m;
  value.max_height_m = high_m;
  value.below = std::move(below);
  value.above = std::move(above);
  return value;
}

TEST(ColumnBuilderTest, AWindowHasWallBelowAndAboveToTheWallsOwnFaces) {
  const ColumnProfile profile = profile_of(heights(0.9, 2.1, "wall", "wall"));
  EXPECT_THAT(profile.slabs,
              ElementsAre(Slab{0.1, 0.9, kWall}, Slab{0.9, 2.1, kOwn}, Slab{2.1, 2.5, kWall}));
  EXPECT_EQ(profile.ground, kFloor);
  EXPECT_FALSE(profile.outside);
}

TEST(ColumnBuilderTest, EmptyIntervalsAddNothing) {
  EXPECT_THAT(profile_of(heights(0.0, 2.6, "wall", "wall")).slabs,
              ElementsAre(Slab{0.0, 2.6, kOwn}));
  EXPECT_THAT(profile_of(heights(0.1, 2.5, "wall", "wall")).slabs,
              ElementsAre(Slab{0.1, 2.5, kOwn}));
}

TEST(ColumnBuilderTest, SlabsAreCutAtGroundAndCeiling) {
  EXPECT_THAT(profile_of(heights(-0.5, 3.0)).slabs, ElementsAre(Slab{0.0, 2.6, kOwn}));
  EXPECT_THAT(profile_of(heights(2.6, 3.0)).slabs, IsEmpty());
  EXPECT_THAT(profile_of(heights(-2.0, 0.0)).slabs, IsEmpty());
  EXPECT_THAT(profile_of(heights(0.5, 9.0), {0.0, kFloor, std::nullopt}).slabs,
              ElementsAre(Slab{0.5, 9.0, kOwn}))
      << "an open top cuts nothing";
  EXPECT_THAT(profile_of(heights(2.0, 5.0), {3.0, kFloor, std::nullopt}).slabs,
              ElementsAre(Slab{3.0, 5.0, kOwn}));
}

TEST(ColumnBuilderTest, BothHeightsAtTheGroundArePaint) {
  const ColumnProfile profile = profile_of(heights(0.0, 0.0));
  EXPECT_THAT(profile.slabs, IsEmpty());
  EXPECT_EQ(profile.ground, kOwn);
}

TEST(ColumnBuilderTest, TouchingSlabsOfOneClassAreOne) {
  EXPECT_THAT(profile_of(heights(0.5, 1.0, "own", "own")).slabs, ElementsAre(Slab{0.5, 1.0, kOwn}));
  MapClass floor;
  floor.name = "floor";
  MapClass box;
  box.name = "box";
  box.max_height_m = 1.0;
  MapClass lid;
  lid.name = "lid";
  lid.min_height_m = 1.0;
  lid.max_height_m = 1.2;
  lid.below = "box";
  lid.above = "box";
  const ColumnProfile profile = column_profile(
      {floor, box, lid}, ClassTable({"floor", "box", "lid"}), 3, {0.0, 1, std::nullopt});
  EXPECT_THAT(profile.slabs, ElementsAre(Slab{0.0, 1.0, 2}, Slab{1.0, 1.2, 3}));
}

TEST(ColumnBuilderTest, PassableIsHandedOn) {
  MapClass door = heights(0.0, 2.1);
  door.passable = true;
  EXPECT_TRUE(profile_of(door).passable);
}

}  // namespace
}  // namespace semview::map::detail
