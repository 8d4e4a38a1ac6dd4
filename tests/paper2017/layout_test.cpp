// SPDX-License-Identifier: Apache-2.0
/// Floors and worlds: what holds for every seed.
#include "experiments/paper2017/layout.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "experiments/paper2017/scene_builder.hpp"
#include "experiments/paper2017/world.hpp"

namespace semview::paper2017 {
namespace {

constexpr std::uint64_t kSeeds[] = {1, 2, 3, 101, 203};

/// Coarse pixels: the tests look at places and seeds.
WorldConfig coarse() {
  WorldConfig config;
  config.camera.pixel_rad = rad_from_deg(4.0);
  return config;
}

TEST(LayoutTest, HasTwoLabsACorridorAndSevenSmallRooms) {
  for (const std::uint64_t seed : kSeeds) {
    const Layout layout = draw_layout({}, seed);
    EXPECT_EQ(layout.rooms[kLabA].kind, RoomKind::kLab);
    EXPECT_EQ(layout.rooms[kLabB].kind, RoomKind::kLab);
    EXPECT_EQ(layout.rooms[kCorridor].kind, RoomKind::kCorridor);
    EXPECT_EQ(std::ranges::count(layout.rooms, RoomKind::kSmall, &Room::kind), 7) << seed;
  }
}

TEST(LayoutTest, EveryRoomHasADoorToTheCorridor) {
  for (const std::uint64_t seed : kSeeds) {
    const Layout layout = draw_layout({}, seed);
    const Room& corridor = layout.rooms[kCorridor];
    for (std::size_t i = 0; i < layout.rooms.size(); ++i) {
      if (i == kCorridor) continue;
      const Room& room = layout.rooms[i];
      const bool connected = std::ranges::any_of(layout.openings, [&](const Opening& opening) {
        const Wall& wall = layout.walls[opening.wall];
        const bool between = (wall.at_m == corridor.min_y_m && room.max_y_m == wall.at_m) ||
                             (wall.at_m == corridor.max_y_m && room.min_y_m == wall.at_m);
        return opening.kind == OpeningKind::kDoor && between && opening.from_m > room.min_x_m &&
               opening.to_m < room.max_x_m;
      });
      EXPECT_TRUE(connected) << "seed " << seed << ", room " << i;
    }
  }
}

TEST(LayoutTest, DoorsOnTheRobotsWayAreOpen) {
  for (const std::uint64_t seed : kSeeds) {
    const Layout layout = draw_layout({}, seed);
    for (const std::size_t used : {kLabA, kLabB, layout.visited_room}) {
      const Room& room = layout.rooms[used];
      EXPECT_TRUE(std::ranges::any_of(layout.openings,
                                      [&](const Opening& opening) {
                                        return opening.kind == OpeningKind::kDoor &&
                                               opening.leaf_angle_rad > 0.0 &&
                                               opening.from_m > room.min_x_m &&
                                               opening.to_m < room.max_x_m;
                                      }))
          << "seed " << seed;
    }
  }
}

TEST(WorldTest, HasFourteenStopsWhereARobotFits) {
  for (const std::uint64_t seed : kSeeds) {
    const World world = make_world(coarse(), WorldSeeds::all(seed));
    ASSERT_EQ(world.stops.size(), static_cast<std::size_t>(kStops));
    const Scene scene = build_scene(world.layout);
    for (const Stop& stop : world.stops) {
      const Pose2& pose = stop.map_from_robot;
      EXPECT_FALSE(scene.blocked(pose.x_m, pose.y_m, 0.2, 0.05, 1.35)) << "seed " << seed;
      EXPECT_TRUE(std::ranges::any_of(world.layout.rooms, [&](const Room& room) {
        return pose.x_m > room.min_x_m && pose.x_m < room.max_x_m && pose.y_m > room.min_y_m &&
               pose.y_m < room.max_y_m;
      }));
    }
  }
}

TEST(WorldTest, EqualSeedsGiveEqualWorlds) {
  const World one = make_world(coarse(), WorldSeeds::all(4));
  const World other = make_world(coarse(), WorldSeeds::all(4));
  for (std::size_t i = 0; i < one.stops.size(); ++i) {
    EXPECT_EQ(one.stops[i].labels, other.stops[i].labels);
    EXPECT_EQ(one.stops[i].map_from_robot, other.stops[i].map_from_robot);
    EXPECT_EQ(one.stops[i].odom_from_robot, other.stops[i].odom_from_robot);
  }
}

TEST(WorldTest, AnotherSegmentationSeedChangesTheLabelsAlone) {
  WorldSeeds seeds = WorldSeeds::all(4);
  const World before = make_world(coarse(), seeds);
  seeds.segmentation = 5;
  const World after = make_world(coarse(), seeds);
  bool labels_differ = false;
  for (std::size_t i = 0; i < before.stops.size(); ++i) {
    EXPECT_EQ(before.stops[i].map_from_robot, after.stops[i].map_from_robot);
    EXPECT_EQ(before.stops[i].odom_from_robot, after.stops[i].odom_from_robot);
    EXPECT_EQ(before.stops[i].truth.labels, after.stops[i].truth.labels);
    labels_differ = labels_differ || !(before.stops[i].labels == after.stops[i].labels);
  }
  EXPECT_TRUE(labels_differ);
}

TEST(WorldTest, AnotherOdometrySeedChangesOdometryAlone) {
  WorldSeeds seeds = WorldSeeds::all(4);
  const World before = make_world(coarse(), seeds);
  seeds.odometry = 5;
  const World after = make_world(coarse(), seeds);
  for (std::size_t i = 1; i < before.stops.size(); ++i) {
    EXPECT_EQ(before.stops[i].map_from_robot, after.stops[i].map_from_robot);
    EXPECT_EQ(before.stops[i].labels, after.stops[i].labels);
    EXPECT_FALSE(before.stops[i].odom_from_robot == after.stops[i].odom_from_robot);
  }
}

TEST(WorldTest, AnotherCameraSeedLeavesTheWay) {
  WorldSeeds seeds = WorldSeeds::all(4);
  const World before = make_world(coarse(), seeds);
  seeds.camera = 5;
  const World after = make_world(coarse(), seeds);
  bool views_differ = false;
  for (std::size_t i = 0; i < before.stops.size(); ++i) {
    EXPECT_EQ(before.stops[i].map_from_robot, after.stops[i].map_from_robot);
    EXPECT_EQ(before.stops[i].odom_from_robot, after.stops[i].odom_from_robot);
    views_differ = views_differ || !(before.stops[i].truth.labels == after.stops[i].truth.labels);
  }
  EXPECT_TRUE(views_differ);
}

}  // namespace
}  // namespace semview::paper2017
