// SPDX-License-Identifier: Apache-2.0
/// The plan as pictures: grey for ROS tools, coloured for people.
#pragma once

#include <cstdint>
#include <vector>

#include "semview/geometry/image.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::map {

// Grey values of a map_server image with `negate: 0`.
inline constexpr std::uint8_t kFreeGrey = 254;
inline constexpr std::uint8_t kOccupiedGrey = 0;
inline constexpr std::uint8_t kUnknownGrey = 205;

/// The plan for map_server: free, occupied, unknown where it is outside.
/// Occupied is what a robot of that height would hit: a slab that reaches into (ground + 0.05 m,
/// ground + height_m); passable columns are free.
Image<std::uint8_t> occupancy_image(const ColumnMap& map, double height_m = 1.2);

/// The plan in its classes' colours, outside in white, objects with heights of their own in the
/// `object_color` of their class. `columns` are those of `map`.
RgbImage plan_image(const SemanticMap& map, const ColumnMap& columns);

/// A shade of a class's colour that tells its objects from what is drawn in it.
Rgb object_color(Rgb class_color);

/// The colour in which each profile of a drawn map is drawn: that of its class, of `outside` for
/// profile 0.
std::vector<Rgb> profile_colors(const SemanticMap& map, Rgb outside);

}  // namespace semview::map
