// SPDX-License-Identifier: Apache-2.0
#include "semview/simulation/free_space.hpp"

#include <algorithm>
#include <cmath>

#include "semview/geometry/image.hpp"

namespace semview::simulation {
namespace {

constexpr double kHalfCell_m = 0.5 * PoseGrid::kCellSize_m;
constexpr int kReach = static_cast<int>(FreeSpace::kHorizon_m / kHalfCell_m);

/// Obstacles on a grid of half cells: even places are cells' centres, odd ones the edges between.
Image<std::uint8_t> obstacles(const map::CellGrid& grid) {
  Image<std::uint8_t> blocked(2 * grid.rows() + 1, 2 * grid.columns() + 1);
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const CellIndex cell{grid.minimum().ix + column, grid.minimum().iy + row};
      const CellIndex east{cell.ix + 1, cell.iy};
      const CellIndex north{cell.ix, cell.iy + 1};
      if (!grid.is_free(cell)) {
        blocked.at(2 * row, 2 * column) = 1;
        continue;
      }
      if (!grid.can_step(cell, east)) blocked.at(2 * row, 2 * column + 1) = 1;
      if (!grid.can_step(cell, north)) blocked.at(2 * row + 1, 2 * column) = 1;
    }
  }
  return blocked;
}

double clearance(const Image<std::uint8_t>& blocked, int row, int column) {
  // Outside the grid there is no free cell: its edge is as good as a wall.
  int nearest = (kReach + 1) * (kReach + 1);
  for (int dr = -kReach; dr <= kReach; ++dr) {
    for (int dc = -kReach; dc <= kReach; ++dc) {
      const int squared = dr * dr + dc * dc;
      if (squared >= nearest) continue;
      const int r = row + dr;
      const int c = column + dc;
      const bool inside = r >= 0 && r < blocked.rows() && c >= 0 && c < blocked.columns();
      if (!inside || blocked.at(r, c) != 0) nearest = squared;
    }
  }
  // From the obstacle's centre to its near edge.
  return std::max(0.0, (std::sqrt(static_cast<double>(nearest)) - 1.0) * kHalfCell_m);
}

}  // namespace

FreeSpace::FreeSpace(const map::CellGrid& grid) : grid_(&grid), free_cells_(grid.free_cells()) {
  const Image<std::uint8_t> blocked = obstacles(grid);
  place_of_.assign(static_cast<std::size_t>(grid.rows()) * static_cast<std::size_t>(grid.columns()),
                   -1);
  for (const CellIndex& cell : free_cells_) {
    const int row = cell.iy - grid.minimum().iy;
    const int column = cell.ix - grid.minimum().ix;
    place_of_[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns()) +
              static_cast<std::size_t>(column)] = static_cast<int>(clearance_m_.size());
    clearance_m_.push_back(clearance(blocked, 2 * row, 2 * column));
  }
}

int FreeSpace::place(const CellIndex& cell) const {
  if (!grid_->contains(cell)) return -1;
  const auto row = static_cast<std::size_t>(cell.iy - grid_->minimum().iy);
  const auto column = static_cast<std::size_t>(cell.ix - grid_->minimum().ix);
  return place_of_[row * static_cast<std::size_t>(grid_->columns()) + column];
}

double FreeSpace::clearance_m(const CellIndex& cell) const {
  const int at = place(cell);
  return at < 0 ? 0.0 : clearance_m_[static_cast<std::size_t>(at)];
}

double FreeSpace::clearance_m(double x_m, double y_m) const {
  const auto cell = PoseGrid::cell(x_m, y_m);
  return cell ? clearance_m(*cell) : 0.0;
}

}  // namespace semview::simulation
