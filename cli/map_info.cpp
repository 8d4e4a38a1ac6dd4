// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "map_verbs.hpp"
#include "semview/core/hash.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

using nlohmann::ordered_json;

struct Options {
  std::string map;
  map::LoadOptions load;
  double eye_height_m = 1.2;
  bool json = false;
};

ordered_json classes_json(const map::SemanticMap& map) {
  ordered_json classes = ordered_json::array();
  for (std::size_t i = 0; i < map.class_details.size(); ++i) {
    const map::MapClass& details = map.class_details[i];
    ordered_json entry{{"id", i + 1}, {"name", details.name}};
    if (details.color) entry["color"] = {details.color->r, details.color->g, details.color->b};
    if (map.columns() != nullptr && details.color) {
      entry["min_height_m"] = details.min_height_m;
      entry["max_height_m"] = details.max_height_m;
      if (!details.above.empty()) entry["above"] = details.above;
      if (!details.below.empty()) entry["below"] = details.below;
    }
    if (details.passable) entry["passable"] = true;
    if (details.movable > 0.0) entry["movable"] = details.movable;
    classes.push_back(std::move(entry));
  }
  return classes;
}

ordered_json info_json(const map::SemanticMap& map, const map::CellGrid& grid) {
  ordered_json info{{"id", map.id},
                    {"name", map.name},
                    {"fingerprint", to_hex(map.fingerprint)},
                    {"kind", map.columns() != nullptr ? "plan" : "mesh"},
                    {"engine", "embree"},
                    {"ground_height_m", map.ground_height_m}};
  if (map.ceiling) info["ceiling_height_m"] = map.ceiling->height_m;
  if (const map::ColumnMap* columns = map.columns()) {
    info["pixels"] = {columns->columns(), columns->rows()};
    info["resolution_m"] = columns->resolution_m;
    info["size_m"] = {columns->columns() * columns->resolution_m,
                      columns->rows() * columns->resolution_m};
    info["origin"] = {columns->origin.x_m, columns->origin.y_m, columns->origin.yaw_rad};
  } else if (const map::MeshGeometry* mesh = map.mesh()) {
    info["vertices"] = mesh->mesh.vertices.size();
    info["triangles"] = mesh->mesh.triangles.size();
  }
  info["free_cells"] = grid.free_count();
  info["free_parts"] = grid.components().size();
  info["classes"] = classes_json(map);
  return info;
}

void print_text(const ordered_json& info) {
  for (const auto& [key, value] : info.items()) {
    if (key == "classes") continue;
    fmt::print("{:<17} {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
  }
  fmt::print("classes\n");
  for (const ordered_json& entry : info["classes"]) {
    fmt::print("{:>5}  {:<16}", entry["id"].get<int>(), entry["name"].get<std::string>());
    if (entry.contains("min_height_m")) {
      fmt::print(" {:g}..{:g} m",
                 entry["min_height_m"].get<double>(),
                 entry["max_height_m"].get<double>());
    }
    for (const char* key : {"below", "above"}) {
      if (entry.contains(key)) fmt::print(", {} {}", key, entry[key].get<std::string>());
    }
    if (entry.contains("passable")) fmt::print(", passable");
    fmt::print("\n");
  }
}

Status show(const Options& options) {
  SEMVIEW_TRY(const map::SemanticMap map, map::load_map(options.map, options.load));
  SEMVIEW_TRY(const map::CellGrid grid, cell_grid_of(map, options.eye_height_m));
  const ordered_json info = info_json(map, grid);
  if (options.json) {
    fmt::print("{}\n", info.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print_text(info);
  }
  return {};
}

}  // namespace

void add_map_info(CLI::App& map, int& exit_code) {
  CLI::App* verb = map.add_subcommand(
      "info", "Say what a map is: id, name, fingerprint, size, classes, free cells, engine.");
  const auto options = std::make_shared<Options>();
  verb->add_option("MAP", options->map, "Map folder, map.yaml or .glb file")->required();
  verb->add_option("--eye-height", options->eye_height_m, "Metres above the ground")
      ->check(CLI::Range(0.05, 100.0))
      ->capture_default_str();
  verb->add_flag("--nearest-colour",
                 options->load.nearest_colour,
                 "Take unknown colours to be the nearest class's");
  verb->add_flag("--json", options->json, "Print it as JSON");
  verb->footer("Example: semview map info maps/duplex_level1 --json");
  verb->callback([options, &exit_code] { exit_code = report(show(*options)); });
}

}  // namespace semview::cli
