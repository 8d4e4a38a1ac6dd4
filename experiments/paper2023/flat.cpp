// SPDX-License-Identifier: Apache-2.0
#include "flat.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "semview/geometry/angle.hpp"

namespace semview::paper2023 {
namespace {

using paper2017::Primitive;
using paper2017::Shape;

constexpr int kTries = 300;
constexpr double kInnerWall_m = 0.10;
constexpr double kOuterWall_m = 0.20;
constexpr double kLintel_m = 2.05;
constexpr double kGap_m = 0.04;  // between things

/// Typical length, width and height of a class, and whether it stands at a wall.
struct Kind {
  double length_m;
  double width_m;
  double height_m;
  bool at_wall;
};

const Kind& kind_of(ThingClass label) {
  static constexpr std::array<Kind, kThingClassCount> kKinds = {{
      {0.45, 0.45, 0.90, false},  // chair
      {1.90, 0.85, 0.80, true},   // sofa
      {1.60, 2.00, 0.95, true},   // bed
      {1.30, 0.80, 0.74, false},  // table
      {1.10, 0.30, 1.35, true},   // television
      {0.50, 0.50, 1.30, true},   // plant
      {0.62, 0.65, 1.75, true},   // refrigerator
      {0.80, 0.55, 0.92, true},   // sink
      {1.00, 0.45, 1.10, true},   // cabinet
      {0.90, 0.32, 1.90, true},   // shelf
      {0.42, 0.42, 1.60, true},   // lamp
      {0.45, 0.38, 0.40, true},   // box
  }};
  return kKinds[static_cast<std::size_t>(label) - 1];
}

const std::vector<std::vector<ThingClass>>& furnishing() {
  using enum ThingClass;
  static const std::vector<std::vector<ThingClass>> kRooms = {
      {kSofa, kTelevision, kShelf, kTable, kChair, kChair, kPlant, kLamp},
      {kTable, kShelf, kShelf, kCabinet, kChair, kPlant, kBox},
      {kRefrigerator, kSink, kCabinet, kCabinet, kTable, kChair, kChair},
      {kBed, kCabinet, kShelf, kLamp, kChair, kBox},
  };
  return kRooms;
}

/// The rectangle, along x and y, that holds a thing.
Area around(const Thing& thing) {
  const double c = std::abs(std::cos(thing.map_from_thing.yaw_rad));
  const double s = std::abs(std::sin(thing.map_from_thing.yaw_rad));
  const double x_m = (c * thing.length_m + s * thing.width_m) / 2.0;
  const double y_m = (s * thing.length_m + c * thing.width_m) / 2.0;
  const Pose2& at = thing.map_from_thing;
  return {at.x_m - x_m, at.y_m - y_m, at.x_m + x_m, at.y_m + y_m};
}

bool overlap(const Area& a, const Area& b, double gap_m) {
  return a.min_x_m < b.max_x_m + gap_m && b.min_x_m < a.max_x_m + gap_m &&
         a.min_y_m < b.max_y_m + gap_m && b.min_y_m < a.max_y_m + gap_m;
}

/// With its back to one of the room's four walls.
Pose2 at_wall(const Area& room, const Thing& thing, Rng& rng) {
  const double off_m = thing.width_m / 2.0 + rng.uniform(0.01, 0.05);
  const std::uint64_t side = rng.below(4);
  const bool along_x = side < 2;
  const double low_m = (along_x ? room.min_x_m : room.min_y_m) + thing.length_m / 2.0;
  const double high_m = (along_x ? room.max_x_m : room.max_y_m) - thing.length_m / 2.0;
  const double along_m = rng.uniform(std::min(low_m, high_m), high_m);
  switch (side) {
    case 0:
      return {along_m, room.min_y_m + off_m, 0.0};
    case 1:
      return {along_m, room.max_y_m - off_m, kPi};
    case 2:
      return {room.min_x_m + off_m, along_m, -kPi / 2.0};
    default:
      return {room.max_x_m - off_m, along_m, kPi / 2.0};
  }
}

class Drawer {
 public:
  Drawer(const FlatConfig& config, std::uint64_t seed)
      : config_(config),
        rng_(seed, "flat"),
        furniture_rng_(seed, "furniture"),
        names_rng_(seed, "names") {}

  Flat draw() {
    flat_.ceiling_m = config_.ceiling_m;
    flat_.named = config_.named;
    flat_.inside = {0.0,
                    0.0,
                    config_.width_m + rng_.uniform(-config_.vary_m, config_.vary_m),
                    config_.depth_m + rng_.uniform(-config_.vary_m, config_.vary_m)};
    rooms();
    floor_and_ceiling();
    for (std::size_t room = 0; room < flat_.rooms.size(); ++room) {
      for (const ThingClass label : furnishing()[room]) furnish(room, label);
    }
    return std::move(flat_);
  }

 private:
  void slab(const Area& area, double z_min_m, double z_max_m) {
    flat_.shell.push_back({Shape::kBox,
                           kNoHit,
                           0,
                           (area.min_x_m + area.max_x_m) / 2.0,
                           (area.min_y_m + area.max_y_m) / 2.0,
                           0.0,
                           (area.max_x_m - area.min_x_m) / 2.0,
                           (area.max_y_m - area.min_y_m) / 2.0,
                           z_min_m,
                           z_max_m});
  }

  /// A wall along x or y with one doorway in it, whose middle is at a share of its length.
  void wall(bool along_x, double at_m, double from_m, double to_m, double share) {
    const double half_m = kInnerWall_m / 2.0;
    const auto area = [&](double from, double to, double half) {
      return along_x ? Area{from, at_m - half, to, at_m + half}
                     : Area{at_m - half, from, at_m + half, to};
    };
    const double middle_m = from_m + share * (to_m - from_m);
    const double open_m = middle_m - config_.doorway_m / 2.0;
    const double shut_m = middle_m + config_.doorway_m / 2.0;
    slab(area(from_m, open_m, half_m), 0.0, config_.ceiling_m);
    slab(area(open_m, shut_m, half_m), kLintel_m, config_.ceiling_m);
    slab(area(shut_m, to_m, half_m), 0.0, config_.ceiling_m);
    flat_.doorways.push_back(area(open_m, shut_m, 0.75));
  }

  void rooms() {
    const Area& in = flat_.inside;
    const double half_m = kInnerWall_m / 2.0;
    const double y_m = in.max_y_m * rng_.uniform(0.46, 0.54);
    const double upper_x_m = in.max_x_m * rng_.uniform(0.44, 0.58);
    const double lower_x_m = in.max_x_m * rng_.uniform(0.42, 0.56);
    flat_.rooms = {{0.0, y_m + half_m, upper_x_m - half_m, in.max_y_m},
                   {upper_x_m + half_m, y_m + half_m, in.max_x_m, in.max_y_m},
                   {0.0, 0.0, lower_x_m - half_m, y_m - half_m},
                   {lower_x_m + half_m, 0.0, in.max_x_m, y_m - half_m}};
    const double left_m = std::min(upper_x_m, lower_x_m);
    const double right_m = std::max(upper_x_m, lower_x_m);
    wall(true, y_m, 0.0, left_m, rng_.uniform(0.3, 0.7));
    slab({left_m, y_m - half_m, right_m, y_m + half_m}, 0.0, config_.ceiling_m);
    wall(true, y_m, right_m, in.max_x_m, rng_.uniform(0.3, 0.7));
    wall(false, upper_x_m, y_m, in.max_y_m, rng_.uniform(0.3, 0.7));
    wall(false, lower_x_m, 0.0, y_m, rng_.uniform(0.3, 0.7));
    const double out_m = kOuterWall_m;
    slab({-out_m, -out_m, in.max_x_m + out_m, 0.0}, 0.0, config_.ceiling_m);
    slab({-out_m, in.max_y_m, in.max_x_m + out_m, in.max_y_m + out_m}, 0.0, config_.ceiling_m);
    slab({-out_m, 0.0, 0.0, in.max_y_m}, 0.0, config_.ceiling_m);
    slab({in.max_x_m, 0.0, in.max_x_m + out_m, in.max_y_m}, 0.0, config_.ceiling_m);
  }

  void floor_and_ceiling() {
    const Area& in = flat_.inside;
    const Area all{
        -kOuterWall_m, -kOuterWall_m, in.max_x_m + kOuterWall_m, in.max_y_m + kOuterWall_m};
    slab(all, -0.2, 0.0);
    slab(all, config_.ceiling_m, config_.ceiling_m + 0.2);
  }

  void furnish(std::size_t room, ThingClass label) {
    Thing thing;
    if (!place_thing(flat_, label, room, furniture_rng_, thing)) return;
    thing.id = static_cast<std::int32_t>(flat_.things.size()) + 1;
    thing.named = names_rng_.uniform() < config_.named;
    flat_.things.push_back(thing);
  }

  const FlatConfig& config_;
  Rng rng_;
  Rng furniture_rng_;
  Rng names_rng_;
  Flat flat_;
};

}  // namespace

Flat draw_flat(const FlatConfig& config, std::uint64_t seed) { return Drawer(config, seed).draw(); }

bool fits(const Flat& flat, const Thing& thing) {
  const Area own = around(thing);
  const Area& room = flat.rooms[thing.room];
  if (own.min_x_m < room.min_x_m || own.max_x_m > room.max_x_m || own.min_y_m < room.min_y_m ||
      own.max_y_m > room.max_y_m) {
    return false;
  }
  return std::ranges::none_of(flat.doorways,
                              [&](const Area& other) { return overlap(own, other, 0.0); }) &&
         std::ranges::none_of(flat.things, [&](const Thing& other) {
           return other.id != thing.id && overlap(own, around(other), kGap_m);
         });
}

bool place_thing(const Flat& flat, ThingClass label, std::size_t room, Rng& rng, Thing& thing) {
  const Kind& kind = kind_of(label);
  const auto about = [&](double size_m) { return size_m * rng.uniform(0.85, 1.15); };
  thing.shape = label;
  thing.name = label;
  thing.room = room;
  const Area& area = flat.rooms[room];
  for (int attempt = 0; attempt < kTries; ++attempt) {
    thing.length_m = about(kind.length_m);
    thing.width_m = about(kind.width_m);
    thing.height_m = about(kind.height_m);
    if (kind.at_wall) {
      thing.map_from_thing = at_wall(area, thing, rng);
    } else {
      thing.map_from_thing = {rng.uniform(area.min_x_m + 0.3, area.max_x_m - 0.3),
                              rng.uniform(area.min_y_m + 0.3, area.max_y_m - 0.3),
                              wrap_angle(rng.uniform(-kPi, kPi))};
    }
    if (fits(flat, thing)) return true;
  }
  return false;
}

paper2017::Scene scene_of(const Flat& flat) {
  std::vector<Primitive> solids = flat.shell;
  for (const Thing& thing : flat.things) {
    for (const Primitive& part : solids_of(thing)) solids.push_back(part);
  }
  return paper2017::Scene(std::move(solids));
}

}  // namespace semview::paper2023
