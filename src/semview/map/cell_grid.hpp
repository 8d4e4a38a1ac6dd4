// SPDX-License-Identifier: Apache-2.0
/// Which cells of the 10 cm grid a robot may stand in, and from which a view can be cast.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/map/column_map.hpp"
#include "semview/map/map_limits.hpp"

namespace semview::map {

/// A 4-connected part of free space.
struct GridComponent {
  CellIndex first;  ///< its first cell, row by row
  std::size_t cells = 0;
};

/// The facts about each cell under a map. Immutable; answers for any cell, also past the map.
class CellGrid {
 public:
  /// What is known of one cell, as bits.
  enum Fact : std::uint8_t {
    kFree = 1,       ///< a robot may stand at its centre
    kHasEye = 2,     ///< the eye over its centre is neither in a slab nor outside
    kEastOpen = 4,   ///< nothing stands between its centre and that of (ix + 1, iy)
    kNorthOpen = 8,  ///< nothing stands between its centre and that of (ix, iy + 1)
  };

  CellGrid() = default;
  /// `facts` holds columns × rows cells, row by row from the lowest iy, starting at `minimum`.
  CellGrid(CellIndex minimum, int columns, int rows, std::vector<std::uint8_t> facts);

  CellIndex minimum() const { return minimum_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  bool contains(const CellIndex& cell) const;

  bool is_free(const CellIndex& cell) const { return (facts(cell) & kFree) != 0; }
  bool has_eye(const CellIndex& cell) const { return (facts(cell) & kHasEye) != 0; }

  /// The cell whose view stands for the view of `cell`: itself if its eye is free, else the nearest
  /// within 0.5 m (between centres) whose eye is; ties: lowest iy, then ix. None: no view.
  std::optional<CellIndex> view_cell(const CellIndex& cell) const;

  std::size_t free_count() const { return free_count_; }
  /// Whether a camera sees anything from anywhere: not if the ceiling is below the eye, say.
  bool any_view() const;
  /// Row by row: lowest iy first, then lowest ix.
  std::vector<CellIndex> free_cells() const;
  /// True if `from` and `to` are free neighbours (of four) with nothing between their centres.
  bool can_step(const CellIndex& from, const CellIndex& to) const;
  /// Free cells that steps lead to from `start`, row by row; empty if `start` is not free.
  std::vector<CellIndex> reachable_from(const CellIndex& start) const;
  /// Free space in connected parts, largest first (ties: first cell).
  std::vector<GridComponent> components() const;

 private:
  std::uint8_t facts(const CellIndex& cell) const;
  std::size_t index(const CellIndex& cell) const;
  /// Marks in `seen` and returns all that steps lead to from a free cell.
  std::vector<CellIndex> flood(const CellIndex& start, std::vector<bool>& seen) const;

  CellIndex minimum_;
  int columns_ = 0;
  int rows_ = 0;
  std::size_t free_count_ = 0;
  std::vector<std::uint8_t> facts_;
};

/// The grid over a drawn map. A cell is free when the pixel under its centre is inside the building
/// and no slab there reaches into (ground + 0.05 m, ground + eye height), passable columns left
/// out. An eye that only touches a slab's face counts as in it: from there nothing sound is seen.
CellGrid build_cell_grid(const ColumnMap& map, double eye_height_m);

}  // namespace semview::map
