// SPDX-License-Identifier: Apache-2.0
#include "furnishing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "semview/core/random.hpp"

namespace semview::paper2017 {
namespace {

constexpr int kTries = 60;
constexpr double kWayWidth_m = 0.55;  ///< left free between things
constexpr double kDoorway_m = 1.0;    ///< left free on either side of a door

struct Footprint {
  double x_m = 0.0;
  double y_m = 0.0;
  double half_x_m = 0.0;
  double half_y_m = 0.0;
};

Footprint footprint(const Pose2& pose, double length_m, double width_m, double margin_m) {
  const double c = std::abs(std::cos(pose.yaw_rad));
  const double s = std::abs(std::sin(pose.yaw_rad));
  return {pose.x_m,
          pose.y_m,
          (c * length_m + s * width_m) / 2.0 + margin_m,
          (s * length_m + c * width_m) / 2.0 + margin_m};
}

bool overlap(const Footprint& a, const Footprint& b) {
  return std::abs(a.x_m - b.x_m) < a.half_x_m + b.half_x_m &&
         std::abs(a.y_m - b.y_m) < a.half_y_m + b.half_y_m;
}

struct Size {
  double length_m, width_m, height_m;
};

/// What pieces of a kind measure.
Size draw_size(FurnitureKind kind, Rng& rng) {
  switch (kind) {
    case FurnitureKind::kDesk:
      return {rng.uniform(1.3, 1.65), rng.uniform(0.70, 0.82), rng.uniform(0.70, 0.77)};
    case FurnitureKind::kTable:
      return {rng.uniform(0.9, 1.5), rng.uniform(0.75, 0.95), rng.uniform(0.70, 0.77)};
    case FurnitureKind::kChair:
      return {rng.uniform(0.42, 0.50), rng.uniform(0.42, 0.50), rng.uniform(0.80, 0.92)};
    case FurnitureKind::kSwivelChair:
      return {rng.uniform(0.50, 0.62), rng.uniform(0.50, 0.62), rng.uniform(0.90, 1.12)};
    case FurnitureKind::kCupboard:
      return {rng.uniform(0.80, 1.20), rng.uniform(0.38, 0.48), rng.uniform(1.75, 2.05)};
    case FurnitureKind::kSideboard:
      return {rng.uniform(1.10, 1.70), rng.uniform(0.38, 0.50), rng.uniform(0.72, 0.90)};
    case FurnitureKind::kSink:
      return {rng.uniform(0.50, 0.65), rng.uniform(0.42, 0.52), rng.uniform(0.82, 0.92)};
    case FurnitureKind::kDividingWall:
      return {rng.uniform(1.6, 2.8), rng.uniform(0.05, 0.09), rng.uniform(1.5, 1.9)};
  }
  return {};
}

class Furnisher {
 public:
  Furnisher(Layout& layout, const LayoutConfig& config, std::uint64_t seed)
      : layout_(layout), config_(config), rng_(seed, "furniture"), clutter_rng_(seed, "clutter") {
    for (const Opening& opening : layout.openings) {
      const Wall& wall = layout.walls[opening.wall];
      const double middle_m = (opening.from_m + opening.to_m) / 2.0;
      const double half_m = (opening.to_m - opening.from_m) / 2.0;
      if (opening.kind == OpeningKind::kDoor) {
        taken_.push_back({middle_m, wall.at_m, half_m + 0.1, kDoorway_m});
      }
    }
  }

  void lab(const Room& room) {
    along_middle(room, FurnitureKind::kDividingWall, 2);
    desks(room, 4);
    against_wall(room, FurnitureKind::kCupboard, 3);
    against_wall(room, FurnitureKind::kSideboard, 2);
    against_wall(room, FurnitureKind::kSink, 1);
    anywhere(room, FurnitureKind::kTable, 1);
    anywhere(room, FurnitureKind::kChair, 2);
  }

  void small(const Room& room) {
    desks(room, 1 + static_cast<int>(rng_.below(2)));
    against_wall(room, FurnitureKind::kCupboard, 1 + static_cast<int>(rng_.below(2)));
    if (rng_.uniform() < 0.6) against_wall(room, FurnitureKind::kSideboard, 1);
    if (rng_.uniform() < 0.35) against_wall(room, FurnitureKind::kSink, 1);
    anywhere(room, FurnitureKind::kChair, 1);
  }

  void corridor(const Room& room) {
    // Narrow: only what stands along its walls, away from doors.
    against_wall(room, FurnitureKind::kCupboard, 2);
    against_wall(room, FurnitureKind::kSideboard, 1);
  }

  void differ() {
    for (Furniture& piece : layout_.furniture) {
      piece.drawn_pose = piece.pose;
      const double draw = rng_.uniform();
      if (draw < config_.missing_in_map) {
        piece.in_map = false;
      } else if (draw < config_.missing_in_map + config_.missing_in_world) {
        piece.in_world = false;
      }
      if (piece.kind == FurnitureKind::kChair || piece.kind == FurnitureKind::kSwivelChair) {
        piece.drawn_pose.x_m += rng_.normal(0.0, config_.chair_shift_m);
        piece.drawn_pose.y_m += rng_.normal(0.0, config_.chair_shift_m);
        piece.drawn_pose.yaw_rad =
            wrap_angle(piece.pose.yaw_rad + rng_.normal(0.0, config_.chair_turn_rad));
      }
      piece.variant = rng_.next_u64();
    }
  }

  void clutter() {
    for (int i = 0; i < config_.floor_clutter; ++i) floor_thing();
    for (int i = 0; i < config_.wall_clutter; ++i) wall_thing();
    for (const Room& room : layout_.rooms) lights(room);
    for (const Opening& opening : layout_.openings) {
      if (opening.kind == OpeningKind::kWindow) beside_window(opening);
    }
    for (const Furniture& piece : layout_.furniture) {
      if (piece.kind == FurnitureKind::kDesk && piece.in_world) monitor(piece);
    }
  }

 private:
  bool place(const Room& room, Furniture piece, double margin_m) {
    const Footprint own = footprint(piece.pose, piece.length_m, piece.width_m, 0.02);
    const double wall_m = 0.16;
    if (own.x_m - own.half_x_m < room.min_x_m + wall_m - 0.12 ||
        own.x_m + own.half_x_m > room.max_x_m - wall_m + 0.12 ||
        own.y_m - own.half_y_m < room.min_y_m + wall_m - 0.12 ||
        own.y_m + own.half_y_m > room.max_y_m - wall_m + 0.12) {
      return false;
    }
    const Footprint wide = footprint(piece.pose, piece.length_m, piece.width_m, margin_m);
    for (const Footprint& other : taken_) {
      if (overlap(wide, other)) return false;
    }
    taken_.push_back(own);
    layout_.furniture.push_back(piece);
    return true;
  }

  Furniture draw(FurnitureKind kind) {
    const Size size = draw_size(kind, rng_);
    Furniture piece;
    piece.kind = kind;
    piece.length_m = size.length_m;
    piece.width_m = size.width_m;
    piece.height_m = size.height_m;
    return piece;
  }

  /// A place with its back to one of the walls, x along the wall.
  Pose2 wall_place(const Room& room, double length_m, double width_m, double gap_m, Rng& rng) {
    const double half_m = width_m / 2.0 + gap_m;
    const std::uint64_t wall = rng.below(4);
    if (wall < 2) {
      const double x_m = rng.uniform(room.min_x_m + length_m / 2.0, room.max_x_m - length_m / 2.0);
      return wall == 0 ? Pose2{x_m, room.min_y_m + half_m, 0.0}
                       : Pose2{x_m, room.max_y_m - half_m, kPi};
    }
    const double y_m = rng.uniform(room.min_y_m + length_m / 2.0, room.max_y_m - length_m / 2.0);
    return wall == 2 ? Pose2{room.min_x_m + half_m, y_m, -kPi / 2.0}
                     : Pose2{room.max_x_m - half_m, y_m, kPi / 2.0};
  }

  bool fits_along(const Room& room, double length_m) const {
    return length_m + 0.4 < std::min(room.max_x_m - room.min_x_m, room.max_y_m - room.min_y_m);
  }

  void against_wall(const Room& room, FurnitureKind kind, int count) {
    for (int i = 0; i < count; ++i) {
      for (int attempt = 0; attempt < kTries; ++attempt) {
        Furniture piece = draw(kind);
        if (!fits_along(room, piece.length_m)) continue;
        piece.pose = wall_place(room, piece.length_m, piece.width_m, 0.17, rng_);
        if (place(room, piece, 0.05)) break;
      }
    }
  }

  /// Desks at a wall or free, each with a swivel chair before it.
  void desks(const Room& room, int count) {
    for (int i = 0; i < count; ++i) {
      for (int attempt = 0; attempt < kTries; ++attempt) {
        Furniture desk = draw(FurnitureKind::kDesk);
        if (!fits_along(room, desk.length_m)) continue;
        desk.pose =
            wall_place(room, desk.length_m, desk.width_m, rng_.uniform() < 0.7 ? 0.18 : 1.2, rng_);
        if (!place(room, desk, 0.1)) continue;
        Furniture chair = draw(FurnitureKind::kSwivelChair);
        const Pose2 before{rng_.uniform(-0.25, 0.25),
                           desk.width_m / 2.0 + rng_.uniform(0.22, 0.5),
                           rng_.normal(-kPi / 2.0, 0.5)};
        chair.pose = desk.pose * before;
        place(room, chair, -0.15);
        break;
      }
    }
  }

  void anywhere(const Room& room, FurnitureKind kind, int count) {
    for (int i = 0; i < count; ++i) {
      for (int attempt = 0; attempt < kTries; ++attempt) {
        Furniture piece = draw(kind);
        piece.pose = {rng_.uniform(room.min_x_m + 0.6, room.max_x_m - 0.6),
                      rng_.uniform(room.min_y_m + 0.6, room.max_y_m - 0.6),
                      rng_.uniform(-kPi, kPi)};
        if (place(room, piece, kind == FurnitureKind::kTable ? kWayWidth_m : 0.15)) break;
      }
    }
  }

  void along_middle(const Room& room, FurnitureKind kind, int count) {
    for (int i = 0; i < count; ++i) {
      for (int attempt = 0; attempt < kTries; ++attempt) {
        Furniture piece = draw(kind);
        piece.pose = {rng_.uniform(room.min_x_m + 1.2, room.max_x_m - 1.2),
                      rng_.uniform(room.min_y_m + 1.2, room.max_y_m - 1.2),
                      rng_.below(2) == 0 ? 0.0 : kPi / 2.0};
        if (place(room, piece, 0.8)) break;
      }
    }
  }

  void floor_thing() {
    for (int attempt = 0; attempt < kTries; ++attempt) {
      const Room& room = layout_.rooms[clutter_rng_.below(layout_.rooms.size())];
      Clutter thing;
      thing.kind = clutter_rng_.uniform() < 0.65 ? ClutterKind::kBox : ClutterKind::kPlant;
      thing.length_m = clutter_rng_.uniform(0.25, 0.55);
      thing.width_m = clutter_rng_.uniform(0.25, 0.45);
      thing.z_max_m = thing.kind == ClutterKind::kBox ? clutter_rng_.uniform(0.2, 0.6)
                                                      : clutter_rng_.uniform(0.6, 1.5);
      thing.pose = wall_place(room, thing.length_m, thing.width_m, 0.2, clutter_rng_);
      thing.pose.yaw_rad = wrap_angle(thing.pose.yaw_rad + clutter_rng_.normal(0.0, 0.4));
      const Footprint own = footprint(thing.pose, thing.length_m, thing.width_m, 0.03);
      if (std::ranges::any_of(taken_, [&](const Footprint& o) { return overlap(own, o); })) {
        continue;
      }
      taken_.push_back(own);
      layout_.clutter.push_back(thing);
      return;
    }
  }

  void wall_thing() {
    const Room& room = layout_.rooms[clutter_rng_.below(layout_.rooms.size())];
    Clutter thing;
    thing.kind = clutter_rng_.uniform() < 0.5 ? ClutterKind::kPainting : ClutterKind::kPoster;
    thing.length_m = clutter_rng_.uniform(0.4, 1.2);
    thing.width_m = 0.04;
    thing.z_min_m = clutter_rng_.uniform(1.0, 1.5);
    thing.z_max_m = thing.z_min_m + clutter_rng_.uniform(0.35, 0.9);
    thing.pose = wall_place(room, thing.length_m, thing.width_m, 0.065, clutter_rng_);
    const Footprint own = footprint(thing.pose, thing.length_m, thing.width_m, 0.0);
    for (const Opening& opening : layout_.openings) {
      const Wall& wall = layout_.walls[opening.wall];
      const bool near = std::abs(own.y_m - wall.at_m) < 0.4;
      if (near && own.x_m + own.half_x_m > opening.from_m &&
          own.x_m - own.half_x_m < opening.to_m) {
        return;
      }
    }
    layout_.clutter.push_back(thing);
  }

  void lights(const Room& room) {
    const double length_m = room.max_x_m - room.min_x_m;
    const int count = std::max(1, static_cast<int>(length_m / 2.5));
    for (int i = 0; i < count; ++i) {
      Clutter light;
      light.kind = ClutterKind::kLight;
      light.pose = {room.min_x_m + length_m * (i + 0.5) / count,
                    (room.min_y_m + room.max_y_m) / 2.0 + clutter_rng_.uniform(-0.2, 0.2),
                    0.0};
      light.length_m = clutter_rng_.uniform(0.5, 1.3);
      light.width_m = 0.25;
      light.z_max_m = layout_.ceiling_m;
      light.z_min_m = layout_.ceiling_m - clutter_rng_.uniform(0.08, 0.4);
      layout_.clutter.push_back(light);
    }
  }

  void beside_window(const Opening& window) {
    const Wall& wall = layout_.walls[window.wall];
    const double inside = wall.at_m > layout_.depth_m / 2.0 ? -1.0 : 1.0;
    const double length_m = window.to_m - window.from_m;
    Clutter radiator;
    radiator.kind = ClutterKind::kRadiator;
    radiator.pose = {(window.from_m + window.to_m) / 2.0, wall.at_m + inside * 0.21, 0.0};
    radiator.length_m = length_m * clutter_rng_.uniform(0.6, 0.95);
    radiator.width_m = 0.10;
    radiator.z_min_m = 0.12;
    radiator.z_max_m = clutter_rng_.uniform(0.55, 0.72);
    layout_.clutter.push_back(radiator);
    if (clutter_rng_.uniform() > 0.4) return;
    Clutter curtain;
    curtain.kind = ClutterKind::kCurtain;
    curtain.length_m = length_m * clutter_rng_.uniform(0.12, 0.45);
    curtain.width_m = 0.06;
    const double side = clutter_rng_.below(2) == 0 ? -1.0 : 1.0;
    curtain.pose = {radiator.pose.x_m + side * (length_m - curtain.length_m) / 2.0,
                    wall.at_m + inside * 0.20,
                    0.0};
    curtain.z_min_m = clutter_rng_.uniform(0.1, 0.9);
    curtain.z_max_m = window.z_max_m + 0.1;
    layout_.clutter.push_back(curtain);
  }

  void monitor(const Furniture& desk) {
    Clutter screen;
    screen.kind = ClutterKind::kMonitor;
    screen.pose = desk.pose * Pose2{clutter_rng_.uniform(-0.3, 0.3), -0.12, 0.0};
    screen.length_m = clutter_rng_.uniform(0.45, 0.65);
    screen.width_m = 0.06;
    screen.z_min_m = desk.height_m + 0.08;
    screen.z_max_m = screen.z_min_m + clutter_rng_.uniform(0.3, 0.4);
    layout_.clutter.push_back(screen);
  }

  Layout& layout_;
  const LayoutConfig& config_;
  Rng rng_;
  Rng clutter_rng_;
  std::vector<Footprint> taken_;
};

}  // namespace

void furnish(Layout& layout, const LayoutConfig& config, std::uint64_t seed) {
  Furnisher furnisher(layout, config, seed);
  for (const Room& room : layout.rooms) {
    if (room.kind == RoomKind::kLab) furnisher.lab(room);
    if (room.kind == RoomKind::kSmall) furnisher.small(room);
    if (room.kind == RoomKind::kCorridor) furnisher.corridor(room);
  }
  furnisher.differ();
  furnisher.clutter();
}

}  // namespace semview::paper2017
