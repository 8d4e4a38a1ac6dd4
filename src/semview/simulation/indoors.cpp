// SPDX-License-Identifier: Apache-2.0
#include "semview/simulation/indoors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace semview::simulation {
namespace {

/// A ring of rays at the height of the eye.
constexpr PanoramaCamera kRing{120, 1, -1e-3, 1e-3};
constexpr std::ptrdiff_t kMostMisses = kRing.columns / 10;

bool is_indoors(const raycast::Engine& engine, const CellIndex& cell, double eye_z_m) {
  raycast::PanoramaRequest request;
  request.map_from_robot = PoseGrid::center(cell);
  request.eye_z_m = eye_z_m;
  request.camera = kRing;
  const raycast::Panorama ring = engine.panorama(request);
  const auto pixels = ring.labels.pixels();
  return std::count(pixels.begin(), pixels.end(), kNoHit) <= kMostMisses;
}

}  // namespace

map::CellGrid indoor_cells(const map::CellGrid& grid,
                           const raycast::Engine& engine,
                           double eye_z_m) {
  std::vector<std::uint8_t> facts;
  facts.reserve(static_cast<std::size_t>(grid.rows()) * static_cast<std::size_t>(grid.columns()));
  std::size_t indoors = 0;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const CellIndex cell{grid.minimum().ix + column, grid.minimum().iy + row};
      // An eye in a slab, as in a closed door, sees nothing either way: such a cell stays.
      const bool stays =
          grid.is_free(cell) && (!grid.has_eye(cell) || is_indoors(engine, cell, eye_z_m));
      unsigned fact = 0;
      if (stays) fact |= map::CellGrid::kFree;
      if (grid.has_eye(cell)) fact |= map::CellGrid::kHasEye;
      if (grid.can_step(cell, {cell.ix + 1, cell.iy})) fact |= map::CellGrid::kEastOpen;
      if (grid.can_step(cell, {cell.ix, cell.iy + 1})) fact |= map::CellGrid::kNorthOpen;
      facts.push_back(static_cast<std::uint8_t>(fact));
      indoors += stays ? 1U : 0U;
    }
  }
  if (2 * indoors < grid.free_count()) return grid;
  return map::CellGrid(grid.minimum(), grid.columns(), grid.rows(), std::move(facts));
}

}  // namespace semview::simulation
