// SPDX-License-Identifier: Apache-2.0
/// The verbs under `semview map`, one file each.
#pragma once

#include "semview/core/result.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"

namespace CLI {
class App;
}

namespace semview::cli {

// Each adds its verb to `map`; when it has run, `exit_code` holds the program's exit code.
void add_map_check(CLI::App& map, int& exit_code);
void add_map_info(CLI::App& map, int& exit_code);
void add_map_pictures(CLI::App& map, int& exit_code);  ///< preview, occupancy
void add_map_import(CLI::App& map, int& exit_code);
void add_map_distort(CLI::App& map, int& exit_code);  ///< distort, rectify
void add_map_export(CLI::App& map, int& exit_code);

/// Adds --nearest-colour.
void add_nearest_colour(CLI::App& verb, map::LoadOptions& load);

/// The grid of any map: from its columns, or by casting rays at its mesh.
Result<map::CellGrid> cell_grid_of(const map::SemanticMap& map, double eye_height_m);

}  // namespace semview::cli
