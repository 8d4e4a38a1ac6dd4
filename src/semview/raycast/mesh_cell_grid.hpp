// SPDX-License-Identifier: Apache-2.0
/// Where a robot may stand in a map that is a mesh.
#pragma once

#include "semview/core/result.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/raycast/scene.hpp"

namespace semview::raycast {

/// The grid over a mesh's bounds, found by casting rays from the eye over each cell's centre.
///
/// An eye is free when a ray down meets a surface and the eye is not inside a solid, that is, most
/// of the rays along the six axes meet no back faces. The cell is free when, besides, the surface
/// below is within 0.05 m of the ground. Two free neighbours are joined when level rays between
/// their centres meet nothing.
///
/// @param eye_height_m  above the ground.
/// @errors kResourceExhausted: the bounds hold more than `map::kMaxGridCells` cells; kOutOfRange:
/// bounds beyond `PoseGrid::kMaxCoordinate_m`.
/// @cost about ten rays a cell: 0.1 s for a 20 m × 20 m building.
Result<map::CellGrid> build_cell_grid(const Scene& scene,
                                      double ground_height_m,
                                      double eye_height_m);

}  // namespace semview::raycast
