// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "map_verbs.hpp"
#include "semview/raycast/mesh_cell_grid.hpp"
#include "semview/raycast/scene.hpp"
#include "verb.hpp"

namespace semview::cli {

void add_map_verb(CLI::App& app, int& exit_code) {
  CLI::App* map = app.add_subcommand("map",
                                     "Check, look at and convert maps. A map is a folder with a "
                                     "map.yaml and a drawing (docs/tutorial.md), or a .glb file.");
  map->require_subcommand(1);
  add_map_check(*map, exit_code);
  add_map_info(*map, exit_code);
  add_map_pictures(*map, exit_code);
  add_map_import(*map, exit_code);
  add_map_distort(*map, exit_code);
  add_map_export(*map, exit_code);
}

void add_nearest_colour(CLI::App& verb, map::LoadOptions& load) {
  verb.add_flag("--nearest-colour",
                load.nearest_colour,
                "Take unknown colours to be the nearest class's, for smoothed drawings");
}

Result<map::CellGrid> cell_grid_of(const map::SemanticMap& map, double eye_height_m) {
  if (const map::ColumnMap* columns = map.columns()) return build_cell_grid(*columns, eye_height_m);
  SEMVIEW_TRY(const raycast::Scene scene, raycast::Scene::build(map.mesh()->mesh));
  return raycast::build_cell_grid(scene, map.ground_height_m, eye_height_m);
}

}  // namespace semview::cli
