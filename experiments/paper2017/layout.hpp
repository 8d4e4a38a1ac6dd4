// SPDX-License-Identifier: Apache-2.0
/// What stands where in an experiment's floor: the one description that the scene is built from and
/// the plan is drawn from, each in its own way.
#pragma once

#include <cstdint>
#include <vector>

#include "semview/geometry/pose2.hpp"

namespace semview::paper2017 {

/// Two labs with dividing walls, seven small rooms and a corridor, as in Neubert et al. 2017,
/// section IV-A; sizes in metres, x along the corridor.
struct LayoutConfig {
  double width_m = 18.0;
  double depth_m = 11.5;
  double missing_in_map = 0.07;    ///< share of furniture that nobody has drawn
  double missing_in_world = 0.07;  ///< share that is drawn and has gone
  double chair_shift_m = 0.18;     ///< σ of how far a chair stands from where it is drawn
  double chair_turn_rad = 0.6;     ///< σ of how it is turned against the drawing
  double other_door_state = 0.15;  ///< share of doors that are open and drawn closed, or reverse
  int floor_clutter = 22;          ///< boxes and plants that no map has
  int wall_clutter = 34;           ///< pictures and posters
};

enum class RoomKind { kLab, kSmall, kCorridor };

struct Room {
  RoomKind kind = RoomKind::kSmall;
  double min_x_m = 0.0;
  double min_y_m = 0.0;
  double max_x_m = 0.0;
  double max_y_m = 0.0;
};

/// A wall along x or y, from floor to ceiling.
struct Wall {
  bool along_x = true;
  double at_m = 0.0;    ///< the other coordinate of its centre line
  double from_m = 0.0;  ///< along it
  double to_m = 0.0;
  double thickness_m = 0.12;
};

enum class OpeningKind { kDoor, kWindow };

/// A hole in a wall, and what fills it.
struct Opening {
  OpeningKind kind = OpeningKind::kDoor;
  std::size_t wall = 0;
  double from_m = 0.0;  ///< along the wall
  double to_m = 0.0;
  double z_min_m = 0.0;
  double z_max_m = 2.05;
  double side = 1.0;            ///< the side of the wall that the leaf turns to: +1 or -1
  double leaf_angle_rad = 0.0;  ///< 0: closed
  bool drawn_open = false;
};

enum class FurnitureKind {
  kDesk,
  kTable,
  kChair,
  kSwivelChair,
  kCupboard,
  kSideboard,
  kSink,
  kDividingWall,
};

struct Furniture {
  FurnitureKind kind = FurnitureKind::kDesk;
  Pose2 pose;        ///< of its middle, x along its length
  Pose2 drawn_pose;  ///< where the map has it
  double length_m = 1.0;
  double width_m = 0.6;
  double height_m = 0.74;
  bool in_world = true;
  bool in_map = true;
  std::uint64_t variant = 0;  ///< what it is made of and called, where its kind leaves a choice
};

enum class ClutterKind { kBox, kPlant, kPainting, kPoster, kLight, kMonitor, kRadiator, kCurtain };

/// Things that no map has.
struct Clutter {
  ClutterKind kind = ClutterKind::kBox;
  Pose2 pose;
  double length_m = 0.3;
  double width_m = 0.3;
  double z_min_m = 0.0;
  double z_max_m = 0.3;
};

struct Layout {
  double width_m = 0.0;
  double depth_m = 0.0;
  double ceiling_m = 2.8;
  std::vector<Room> rooms;  ///< the first is lab A, the second lab B, the third the corridor
  std::vector<Wall> walls;
  std::vector<Opening> openings;
  std::vector<Furniture> furniture;
  std::vector<Clutter> clutter;
  std::size_t visited_room = 3;  ///< the small room that the robot's way leads into
};

inline constexpr std::size_t kLabA = 0;
inline constexpr std::size_t kLabB = 1;
inline constexpr std::size_t kCorridor = 2;

/// The floor of one world seed. Equal arguments give equal floors on every machine.
Layout draw_layout(const LayoutConfig& config, std::uint64_t seed);

}  // namespace semview::paper2017
