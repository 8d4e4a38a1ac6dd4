// SPDX-License-Identifier: Apache-2.0
/// How far the nearest obstacle is from each free cell.
#pragma once

#include <vector>

#include "semview/geometry/pose_grid.hpp"
#include "semview/map/cell_grid.hpp"

namespace semview::simulation {

/// Clearances over a cell grid: what a path planner needs to know of a building.
class FreeSpace {
 public:
  /// Clearances are exact up to this; farther obstacles count as this far.
  static constexpr double kHorizon_m = 1.0;

  explicit FreeSpace(const map::CellGrid& grid);

  /// Metres from the cell's centre to the nearest obstacle (a cell that is not free, or a wall too
  /// thin to cover one), 0 where the cell is not free.
  double clearance_m(const CellIndex& cell) const;
  double clearance_m(double x_m, double y_m) const;

  const map::CellGrid& grid() const { return *grid_; }
  /// Row by row.
  const std::vector<CellIndex>& free_cells() const { return free_cells_; }
  /// A place in `free_cells()` for each cell of the grid's rectangle, -1 where not free.
  int place(const CellIndex& cell) const;

 private:
  const map::CellGrid* grid_;
  std::vector<CellIndex> free_cells_;
  std::vector<int> place_of_;
  std::vector<double> clearance_m_;
};

}  // namespace semview::simulation
