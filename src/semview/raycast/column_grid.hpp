// SPDX-License-Identifier: Apache-2.0
/// A plan packed for walking: what stands over a pixel, and how far around it nothing else does.
/// Internal to this module.
#pragma once

#include <cstdint>
#include <vector>

#include "semview/map/column_map.hpp"

namespace semview::raycast {

/// One cell a pixel, row by row from the lowest up, with a border of one cell all around that ends
/// every walk.
///
/// The low byte of a cell holds its reach (all pixels nearer than this many rows and columns have
/// its profile; 0 on the border) and `kClosed`, the high byte its profile.
struct ColumnGrid {
  static constexpr std::uint16_t kReachMask = 0x7F;
  /// The profile hides all that is behind it from an eye between `ground` and `top`.
  static constexpr std::uint16_t kClosed = 0x80;

  std::vector<std::uint16_t> cells;  // one more than (columns + 2) · (rows + 2): reads take pairs
  int columns = 0;                   // without the border
  int rows = 0;
  double resolution_m = 0.0;
  double ground_m = 0.0;
  double top_m = 0.0;  // nothing is higher: the ceiling, or the highest slab

  int stride() const { return columns + 2; }
};

/// Profiles that look alike share one id in the grid, the lowest.
ColumnGrid build_column_grid(const map::ColumnMap& plan);

}  // namespace semview::raycast
