// SPDX-License-Identifier: Apache-2.0
/// A plan packed for walking: what stands over a pixel, and how far around it nothing else does.
/// Internal to this module.
#pragma once

#include <cstdint>
#include <vector>

#include "semview/map/column_map.hpp"

namespace semview::raycast {

/// Four planes, one for each pair of directions in which a ray can go along the axes. A plane has
/// one cell a pixel, row by row from the lowest up, and a border of one cell all around.
///
/// The low byte of a cell is its reach: in the plane's directions, this many rows and columns from
/// the cell on (itself included) have its profile. The high byte is the profile. A walk ends where
/// the reach is 0: on the border, and where the profile is closed.
///
/// A profile is closed if its slabs have no gap from the ground to the top of all things: from an
/// eye between the two nothing behind it is seen, since what passes below the ground or above the
/// top never comes back.
struct ColumnGrid {
  static constexpr std::uint16_t kReachMask = 0xFF;
  static constexpr int kPlanes = 4;

  std::vector<std::uint16_t> cells;  // one more than the planes need: a read takes two
  int columns = 0;                   // without the border
  int rows = 0;
  double resolution_m = 0.0;
  double ground_m = 0.0;
  double top_m = 0.0;  // nothing is higher: the ceiling, or the highest slab

  int stride() const { return columns + 2; }
  int plane_size() const { return stride() * (rows + 2); }
  /// Of rays that fall along an axis, and rise if not.
  static int plane(bool falls_u, bool falls_v) { return (falls_u ? 1 : 0) + (falls_v ? 2 : 0); }
};

/// Profiles that look alike share one id in the grid, the lowest.
ColumnGrid build_column_grid(const map::ColumnMap& plan);

}  // namespace semview::raycast
