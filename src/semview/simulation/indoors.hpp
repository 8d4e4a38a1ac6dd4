// SPDX-License-Identifier: Apache-2.0
/// Which free cells lie in the building, and not on a terrace or a balcony that the plan shows.
#pragma once

#include "semview/map/cell_grid.hpp"
#include "semview/raycast/engine.hpp"

namespace semview::simulation {

/// `grid` without the free cells from which more than a tenth of a level turn meets nothing: out
/// there a camera sees a façade and the sky, which a floor plan says nothing about.
///
/// Where that leaves less than half of the free cells, as in a plan without outer walls, all stay.
/// @param engine  casts the building with its doors and windows shut
map::CellGrid indoor_cells(const map::CellGrid& grid,
                           const raycast::Engine& engine,
                           double eye_z_m);

}  // namespace semview::simulation
