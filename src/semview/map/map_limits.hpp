// SPDX-License-Identifier: Apache-2.0
/// What a map may at most be. docs/formats/map_bundle.md lists the same.
#pragma once

#include <cstddef>
#include <string_view>

namespace semview::map {

inline constexpr double kMinResolution_m = 0.001;  ///< a pixel's edge
inline constexpr double kMaxResolution_m = 1.0;
inline bool is_valid_resolution(double resolution_m) {
  return resolution_m >= kMinResolution_m && resolution_m <= kMaxResolution_m;
}
/// Within the grid's own limit with room for the largest image.
inline constexpr double kMaxOrigin_m = 900'000.0;
inline constexpr double kMaxHeight_m = 10'000.0;  ///< of faces, above and below 0
/// Cells of the 10 cm grid under a map: 1 km². Images have limits of their own, see io/png.hpp.
inline constexpr std::size_t kMaxGridCells = 100'000'000;
/// `objects.geojson`: its size, its features, the points of all of them and of one polygon.
inline constexpr std::size_t kMaxObjectBytes = std::size_t{16} << 20U;
inline constexpr std::size_t kMaxObjects = 10'000;
inline constexpr std::size_t kMaxObjectPoints = 500'000;
inline constexpr std::size_t kMaxPolygonPoints = 10'000;
/// Pixels have one byte, and profile 0 is outside.
inline constexpr std::size_t kMaxProfiles = 256;
inline constexpr std::size_t kMaxMapIdLength = 64;
inline constexpr std::size_t kMaxClassNameLength = 64;

/// An id is 1 to `kMaxMapIdLength` of a-z, 0-9, _ and -.
inline bool is_map_id(std::string_view id) {
  return !id.empty() && id.size() <= kMaxMapIdLength &&
         id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-") == std::string_view::npos;
}

}  // namespace semview::map
