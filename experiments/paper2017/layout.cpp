// SPDX-License-Identifier: Apache-2.0
#include "layout.hpp"

#include <algorithm>
#include <cmath>

#include "furnishing.hpp"
#include "semview/core/random.hpp"

namespace semview::paper2017 {
namespace {

constexpr double kOuterWall_m = 0.30;
constexpr double kInnerWall_m = 0.12;

/// `parts` + 1 borders from `low` to `high`, parts of nearly equal length.
std::vector<double> borders(double low, double high, int parts, Rng& rng) {
  std::vector<double> all{low};
  const double step = (high - low) / parts;
  for (int i = 1; i < parts; ++i) all.push_back(low + step * (i + rng.uniform(-0.18, 0.18)));
  all.push_back(high);
  return all;
}

void add_wall(
    Layout& layout, bool along_x, double at_m, double from_m, double to_m, double thickness_m) {
  layout.walls.push_back({along_x, at_m, from_m, to_m, thickness_m});
}

/// A row of rooms between two walls along x, with walls between them.
void add_band(Layout& layout,
              const std::vector<double>& borders_m,
              std::size_t lab,
              double min_y_m,
              double max_y_m) {
  for (std::size_t i = 0; i + 1 < borders_m.size(); ++i) {
    const Room room{i == lab ? RoomKind::kLab : RoomKind::kSmall,
                    borders_m[i],
                    min_y_m,
                    borders_m[i + 1],
                    max_y_m};
    if (i == lab) {
      layout.rooms[max_y_m < layout.depth_m / 2.0 ? kLabB : kLabA] = room;
    } else {
      layout.rooms.push_back(room);
    }
    if (i > 0) add_wall(layout, false, borders_m[i], min_y_m, max_y_m, kInnerWall_m);
  }
}

/// A door from each room to the corridor. Walls 4 and 5 are the corridor's.
void add_doors(Layout& layout, const LayoutConfig& config, Rng& rng) {
  for (std::size_t i = 0; i < layout.rooms.size(); ++i) {
    if (i == kCorridor) continue;
    const Room& room = layout.rooms[i];
    Opening door;
    const bool above = room.min_y_m > layout.depth_m / 2.0;
    door.wall = above ? 5 : 4;
    const double width_m = rng.uniform(0.84, 0.96);
    const double play_m = std::max(0.05, room.max_x_m - room.min_x_m - width_m - 0.5);
    door.from_m = room.min_x_m + 0.25 + rng.uniform(0.0, play_m);
    door.to_m = door.from_m + width_m;
    door.z_max_m = rng.uniform(1.98, 2.10);
    door.side = above ? 1.0 : -1.0;
    const bool used = i == kLabA || i == kLabB || i == layout.visited_room;
    const bool open = used || rng.uniform() < 0.5;
    if (open) door.leaf_angle_rad = rng.uniform(1.0, 1.9);
    door.drawn_open = open != (rng.uniform() < config.other_door_state);
    layout.openings.push_back(door);
  }
}

void add_windows(Layout& layout, Rng& rng) {
  for (std::size_t i = 0; i < layout.rooms.size(); ++i) {
    if (i == kCorridor) continue;
    const Room& room = layout.rooms[i];
    const double width_m = room.max_x_m - room.min_x_m;
    const int count = width_m > 4.5 ? 3 : (width_m > 2.9 ? 2 : 1);
    for (int k = 0; k < count; ++k) {
      Opening window;
      window.kind = OpeningKind::kWindow;
      window.wall = room.min_y_m > layout.depth_m / 2.0 ? 1 : 0;
      const double share_m = width_m / count;
      const double size_m = std::min(share_m - 0.5, rng.uniform(1.0, 1.6));
      const double middle_m = room.min_x_m + share_m * (k + 0.5) + rng.uniform(-0.12, 0.12);
      window.from_m = middle_m - size_m / 2.0;
      window.to_m = middle_m + size_m / 2.0;
      window.z_min_m = rng.uniform(0.82, 0.98);
      window.z_max_m = rng.uniform(2.05, 2.30);
      layout.openings.push_back(window);
    }
  }
}

}  // namespace

Layout draw_layout(const LayoutConfig& config, std::uint64_t seed) {
  Rng rng(seed, "layout");
  Layout layout;
  layout.width_m = config.width_m;
  layout.depth_m = config.depth_m;
  layout.ceiling_m = rng.uniform(2.70, 2.95);
  const double corridor_low_m = rng.uniform(4.6, 5.1);
  const double corridor_high_m = corridor_low_m + rng.uniform(1.7, 2.0);

  constexpr double kCorner_m = kOuterWall_m / 2.0;
  add_wall(layout, true, 0.0, -kCorner_m, layout.width_m + kCorner_m, kOuterWall_m);
  add_wall(layout, true, layout.depth_m, -kCorner_m, layout.width_m + kCorner_m, kOuterWall_m);
  add_wall(layout, false, 0.0, 0.0, layout.depth_m, kOuterWall_m);
  add_wall(layout, false, layout.width_m, 0.0, layout.depth_m, kOuterWall_m);
  add_wall(layout, true, corridor_low_m, 0.0, layout.width_m, kInnerWall_m);
  add_wall(layout, true, corridor_high_m, 0.0, layout.width_m, kInnerWall_m);

  layout.rooms.resize(3);
  layout.rooms[kCorridor] = {
      RoomKind::kCorridor, 0.0, corridor_low_m, layout.width_m, corridor_high_m};
  // Lab A above on the left with four small rooms beside it, lab B below between two and one.
  const double lab_a_m = rng.uniform(5.4, 6.6);
  std::vector<double> upper = borders(lab_a_m, layout.width_m, 4, rng);
  upper.insert(upper.begin(), 0.0);
  add_band(layout, upper, 0, corridor_high_m, layout.depth_m);
  const double lab_b_m = layout.width_m - rng.uniform(9.6, 10.6);
  std::vector<double> lower = borders(0.0, lab_b_m, 2, rng);
  lower.push_back(lab_b_m + rng.uniform(5.4, 6.6));
  lower.push_back(layout.width_m);
  add_band(layout, lower, 2, 0.0, corridor_low_m);

  layout.visited_room = 3 + rng.below(2);
  add_doors(layout, config, rng);
  add_windows(layout, rng);
  furnish(layout, config, seed);
  return layout;
}

}  // namespace semview::paper2017
