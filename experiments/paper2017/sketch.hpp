// SPDX-License-Identifier: Apache-2.0
/// A floor as somebody sketches it from memory: rooms in the right order, sizes by guess.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout.hpp"
#include "semview/geometry/pose2.hpp"

namespace semview::paper2017 {

struct SketchConfig {
  double least_factor = 0.7;  ///< of a room's length, and of the depth that a row of rooms shares
  double most_factor = 1.4;
  double least_end_m = 0.3;  ///< how far the ends of walls are off
  double most_end_m = 0.8;
  double missing_walls = 0.1;            ///< share of the walls between rooms that are not drawn
  double missing_furniture = 1.0 / 6.0;  ///< share of the drawn furniture
  double swapped_furniture = 1.0 / 6.0;  ///< share drawn as something else
};

/// A sketch, and where each place of the true floor is in it. Rooms keep their indices.
struct Sketch {
  Layout drawn;
  std::vector<Room> true_rooms;

  /// A place keeps its share of its room's length and depth, and its yaw; one outside of all rooms
  /// stays.
  Pose2 sketch_from_true(const Pose2& place) const;
};

/// Both rows of rooms are as long as the drawn building, so the factors of the upper row are
/// stretched to fit. Equal arguments give equal sketches on every machine.
Sketch draw_sketch(const Layout& layout, const SketchConfig& config, std::uint64_t seed);

/// The room that holds a place; `kNoRoom` outside of all.
std::size_t room_of(std::span<const Room> rooms, const Pose2& place);
inline constexpr std::size_t kNoRoom = static_cast<std::size_t>(-1);

}  // namespace semview::paper2017
