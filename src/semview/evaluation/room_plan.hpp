// SPDX-License-Identifier: Apache-2.0
/// Rooms of a building and of a sketch of it: is the robot in the right one?
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/pose2.hpp"

namespace semview::evaluation {

/// A rectangle along the axes of frame `map`.
struct NamedRoom {
  std::string name;
  double min_x_m = 0.0;
  double min_y_m = 0.0;
  double max_x_m = 0.0;
  double max_y_m = 0.0;

  bool holds(const Pose2& place) const {
    return place.x_m >= min_x_m && place.x_m < max_x_m && place.y_m >= min_y_m &&
           place.y_m < max_y_m;
  }
};

/// Reads a CSV file with the columns `room,min_x_m,min_y_m,max_x_m,max_y_m`; empty lines and lines
/// that begin with '#' count for nothing.
/// @errors those of reading; kInvalidArgument with file and line: not such a file, a room without
/// a name, of the name of another, or with no area.
Result<std::vector<NamedRoom>> read_rooms(const std::filesystem::path& path);

/// The first room that holds a place; null outside of all.
const NamedRoom* room_at(std::span<const NamedRoom> rooms, const Pose2& place);

/// What was found at the places where a robot was.
struct RoomScore {
  std::size_t places = 0;                ///< compared: those that lie in a true room
  std::size_t outside = 0;               ///< where the robot was in none, and nothing is compared
  std::size_t right = 0;                 ///< of them in the room of the same name
  std::vector<std::string> true_order;   ///< rooms as visited, each repetition once
  std::vector<std::string> found_order;  ///< "" outside of all rooms
  double mean_error_m = 0.0;  ///< of the places whose room both have, see `moved_with_room`
};

/// Where a place is on another drawing of its room: it keeps its share of length and width.
/// None if it is in no room, or the other drawing has none of that name.
std::optional<Pose2> moved_with_room(std::span<const NamedRoom> from,
                                     std::span<const NamedRoom> to,
                                     const Pose2& place);

/// @param truth   where the robot was, in the frame of `true_rooms`
/// @param found   where it was thought to be, in the frame of `drawn_rooms`; as many
RoomScore score_rooms(std::span<const NamedRoom> true_rooms,
                      std::span<const NamedRoom> drawn_rooms,
                      std::span<const Pose2> truth,
                      std::span<const Pose2> found);

}  // namespace semview::evaluation
