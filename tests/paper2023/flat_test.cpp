// SPDX-License-Identifier: Apache-2.0
#include "experiments/paper2023/flat.hpp"

#include <set>

#include <gtest/gtest.h>

#include "semview/geometry/angle.hpp"

namespace semview::paper2023 {
namespace {

TEST(FlatTest, HoldsAllClassesInARingOfFourRooms) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Flat flat = draw_flat({}, seed);
    EXPECT_NEAR(flat.inside.max_x_m, 9.0, 0.3);
    EXPECT_NEAR(flat.inside.max_y_m, 7.0, 0.3);
    EXPECT_EQ(flat.rooms.size(), 4U);
    EXPECT_EQ(flat.doorways.size(), 4U);
    std::set<ThingClass> classes;
    for (const Thing& thing : flat.things) classes.insert(thing.name);
    EXPECT_GE(classes.size(), 11U) << "seed " << seed;
    EXPECT_GE(flat.things.size(), 22U) << "seed " << seed;
  }
}

TEST(FlatTest, NothingStandsInAnotherThing) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Flat flat = draw_flat({}, seed);
    for (const Thing& thing : flat.things) EXPECT_TRUE(fits(flat, thing)) << seed;
    Thing twin = flat.things.front();
    twin.id = 1000;
    EXPECT_FALSE(fits(flat, twin));
  }
}

TEST(FlatTest, ASeedIsAFlat) {
  const Flat flat = draw_flat({}, 3);
  const Flat again = draw_flat({}, 3);
  const Flat other = draw_flat({}, 4);
  EXPECT_EQ(flat.inside.max_x_m, again.inside.max_x_m);
  ASSERT_EQ(flat.things.size(), again.things.size());
  for (std::size_t i = 0; i < flat.things.size(); ++i) {
    EXPECT_EQ(flat.things[i].map_from_thing, again.things[i].map_from_thing);
  }
  EXPECT_NE(flat.inside.max_x_m, other.inside.max_x_m);
}

TEST(FlatTest, ALampIsSeenAsALamp) {
  Thing lamp;
  lamp.id = 4;
  lamp.shape = ThingClass::kLamp;
  lamp.name = ThingClass::kPlant;  // looks like another class
  lamp.map_from_thing = {2.0, 0.0, 0.0};
  lamp.length_m = 0.4;
  lamp.height_m = 1.6;
  const paper2017::Scene scene(solids_of(lamp));
  const auto hit = scene.cast({0.0, 0.0, 1.5}, {1.0, 0.0, 0.0});
  EXPECT_NEAR(hit.range_m, 1.8, 1e-12);
  EXPECT_EQ(hit.object, 4);
  EXPECT_EQ(hit.label, static_cast<ClassId>(ThingClass::kPlant));
  EXPECT_NEAR(scene.cast({0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}).range_m, 1.98, 1e-12);
}

}  // namespace
}  // namespace semview::paper2023
