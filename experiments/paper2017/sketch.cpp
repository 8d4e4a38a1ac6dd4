// SPDX-License-Identifier: Apache-2.0
#include "sketch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "semview/core/random.hpp"

namespace semview::paper2017 {
namespace {

// As `draw_layout` numbers them: walls 0 to 3 are the outer ones (below, above, left, right), then
// the corridor's; the others stand between rooms.
constexpr std::size_t kUpperWall = 1;
constexpr std::size_t kRightWall = 3;
constexpr std::size_t kLowerCorridorWall = 4;
constexpr std::size_t kUpperCorridorWall = 5;
constexpr std::size_t kFirstInnerWall = 6;

/// Kinds that are drawn differently from one another.
constexpr std::array<FurnitureKind, 5> kDrawnKinds = {FurnitureKind::kTable,
                                                      FurnitureKind::kChair,
                                                      FurnitureKind::kCupboard,
                                                      FurnitureKind::kSideboard,
                                                      FurnitureKind::kSink};

bool looks_the_same(FurnitureKind kind, FurnitureKind drawn) {
  if (kind == FurnitureKind::kDesk) return drawn == FurnitureKind::kTable;
  if (kind == FurnitureKind::kSwivelChair) return drawn == FurnitureKind::kChair;
  return kind == drawn;
}

bool is_upper(const Layout& layout, const Room& room) {
  return room.min_y_m > layout.depth_m / 2.0;
}

double share(double value, double low, double high) {
  return high > low ? (value - low) / (high - low) : 0.5;
}

double between(double low, double high, double part) { return low + part * (high - low); }

/// The rooms of one side of the corridor, from left to right.
std::vector<std::size_t> row_of_rooms(const Layout& layout, bool upper) {
  std::vector<std::size_t> rooms;
  for (std::size_t i = 0; i < layout.rooms.size(); ++i) {
    if (i != kCorridor && is_upper(layout, layout.rooms[i]) == upper) rooms.push_back(i);
  }
  std::ranges::sort(rooms, {}, [&](std::size_t i) { return layout.rooms[i].min_x_m; });
  return rooms;
}

class Sketcher {
 public:
  Sketcher(const Layout& truth, const SketchConfig& config, std::uint64_t seed)
      : truth_(truth), config_(config), rng_(seed, "sketch"), sketch_{truth, truth.rooms} {}

  Sketch draw() {
    depths();
    lengths(false);
    lengths(true);
    walls();
    openings();
    furniture();
    return std::move(sketch_);
  }

 private:
  Layout& drawn() { return sketch_.drawn; }
  double factor() { return rng_.uniform(config_.least_factor, config_.most_factor); }
  double end_error_m() {
    const double off_m = rng_.uniform(config_.least_end_m, config_.most_end_m);
    return rng_.below(2) == 0 ? off_m : -off_m;
  }

  void depths() {
    const Room& corridor = truth_.rooms[kCorridor];
    const double low_m = corridor.min_y_m * factor();
    const double high_m = low_m + (corridor.max_y_m - corridor.min_y_m) * factor();
    drawn().depth_m = high_m + (truth_.depth_m - corridor.max_y_m) * factor();
    for (std::size_t i = 0; i < truth_.rooms.size(); ++i) {
      Room& room = drawn().rooms[i];
      const bool upper = is_upper(truth_, truth_.rooms[i]);
      room.min_y_m = i == kCorridor ? low_m : (upper ? high_m : 0.0);
      room.max_y_m = i == kCorridor ? high_m : (upper ? drawn().depth_m : low_m);
    }
  }

  /// Each room by a factor of its own; then the whole row as long as the drawn building, which is
  /// as long as the lower row comes out.
  void lengths(bool upper) {
    const std::vector<std::size_t> rooms = row_of_rooms(truth_, upper);
    std::vector<double> lengths_m;
    double total_m = 0.0;
    for (const std::size_t i : rooms) {
      lengths_m.push_back((truth_.rooms[i].max_x_m - truth_.rooms[i].min_x_m) * factor());
      total_m += lengths_m.back();
    }
    if (!upper) {
      drawn().width_m = total_m;
      drawn().rooms[kCorridor].max_x_m = total_m;
    }
    double at_m = 0.0;
    for (std::size_t k = 0; k < rooms.size(); ++k) {
      Room& room = drawn().rooms[rooms[k]];
      room.min_x_m = at_m;
      at_m += lengths_m[k] * drawn().width_m / total_m;
      room.max_x_m = at_m;
    }
  }

  void walls() {
    const double corner_m = truth_.walls.front().thickness_m / 2.0;
    const Room& corridor = drawn().rooms[kCorridor];
    for (std::size_t i = 0; i < kFirstInnerWall; ++i) {
      Wall& wall = drawn().walls[i];
      wall.to_m = wall.along_x ? drawn().width_m : drawn().depth_m;
      if (i < kLowerCorridorWall && wall.along_x) wall.to_m += corner_m;
    }
    drawn().walls[kUpperWall].at_m = drawn().depth_m;
    drawn().walls[kRightWall].at_m = drawn().width_m;
    drawn().walls[kLowerCorridorWall].at_m = corridor.min_y_m;
    drawn().walls[kUpperCorridorWall].at_m = corridor.max_y_m;
    for (std::size_t i = kFirstInnerWall; i < truth_.walls.size(); ++i) inner_wall(i);
  }

  /// Moves with the room on its right; its end at the corridor is drawn too short or too long.
  void inner_wall(std::size_t i) {
    const Wall& from = truth_.walls[i];
    Wall& wall = drawn().walls[i];
    const Room& corridor = drawn().rooms[kCorridor];
    const bool upper = (from.from_m + from.to_m) / 2.0 > truth_.depth_m / 2.0;
    for (const std::size_t room : row_of_rooms(truth_, upper)) {
      if (std::abs(truth_.rooms[room].min_x_m - from.at_m) < 1e-9) {
        wall.at_m = drawn().rooms[room].min_x_m;
      }
    }
    const double off_m = end_error_m();
    wall.from_m = upper ? corridor.max_y_m + off_m : 0.0;
    wall.to_m = upper ? drawn().depth_m : corridor.min_y_m + off_m;
    if (rng_.uniform() < config_.missing_walls) wall.to_m = wall.from_m;
  }

  /// Along x, in the row of rooms that the opening's wall belongs to.
  double along(bool upper, double x_m) const {
    for (const std::size_t i : row_of_rooms(truth_, upper)) {
      const Room& from = truth_.rooms[i];
      if (x_m > from.max_x_m) continue;
      const Room& to = sketch_.drawn.rooms[i];
      return between(to.min_x_m, to.max_x_m, share(x_m, from.min_x_m, from.max_x_m));
    }
    return sketch_.drawn.width_m;
  }

  /// Doors and windows keep their width: that of a door is known.
  void openings() {
    for (Opening& opening : drawn().openings) {
      const double half_m = (opening.to_m - opening.from_m) / 2.0;
      const bool upper = opening.wall == kUpperWall || opening.wall == kUpperCorridorWall;
      const double middle_m = along(upper, opening.from_m + half_m);
      opening.from_m = middle_m - half_m;
      opening.to_m = middle_m + half_m;
    }
  }

  void furniture() {
    for (Furniture& piece : drawn().furniture) {
      piece.drawn_pose = sketch_.sketch_from_true(piece.drawn_pose);
      piece.pose = piece.drawn_pose;
      const double draw = rng_.uniform();
      std::size_t other = rng_.below(kDrawnKinds.size());
      if (looks_the_same(piece.kind, kDrawnKinds[other])) other = (other + 1) % kDrawnKinds.size();
      if (draw < config_.missing_furniture) {
        piece.in_map = false;
      } else if (draw < config_.missing_furniture + config_.swapped_furniture) {
        piece.kind = kDrawnKinds[other];
      }
    }
  }

  const Layout& truth_;
  SketchConfig config_;
  Rng rng_;
  Sketch sketch_;
};

}  // namespace

std::size_t room_of(std::span<const Room> rooms, const Pose2& place) {
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    const Room& room = rooms[i];
    if (place.x_m >= room.min_x_m && place.x_m < room.max_x_m && place.y_m >= room.min_y_m &&
        place.y_m < room.max_y_m) {
      return i;
    }
  }
  return kNoRoom;
}

Pose2 Sketch::sketch_from_true(const Pose2& place) const {
  const std::size_t index = room_of(true_rooms, place);
  if (index == kNoRoom) return place;
  const Room& from = true_rooms[index];
  const Room& to = drawn.rooms[index];
  return {between(to.min_x_m, to.max_x_m, share(place.x_m, from.min_x_m, from.max_x_m)),
          between(to.min_y_m, to.max_y_m, share(place.y_m, from.min_y_m, from.max_y_m)),
          place.yaw_rad};
}

Sketch draw_sketch(const Layout& layout, const SketchConfig& config, std::uint64_t seed) {
  return Sketcher(layout, config, seed).draw();
}

}  // namespace semview::paper2017
