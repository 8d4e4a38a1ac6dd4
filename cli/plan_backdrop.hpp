// SPDX-License-Identifier: Apache-2.0
/// A map's plan as the background of pictures.
#pragma once

#include "semview/map/semantic_map.hpp"
#include "semview/picture/plan.hpp"

namespace semview::cli {

inline constexpr Rgb kFreeColour{226, 221, 208};

/// What a mesh has in the place of a plan: its free cells for an eye 1.2 m above the ground, in
/// `kFreeColour` on white.
/// @errors those of `cell_grid_of`.
Result<picture::Plan> free_cells_plan(const map::SemanticMap& map);

/// The plan in quiet colours, floor nearly white, so that what is drawn on it stands out; a mesh's
/// free cells.
/// @errors those of `free_cells_plan`.
Result<picture::Plan> plan_backdrop(const map::SemanticMap& map);

}  // namespace semview::cli
