// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "map_box.hpp"
#include "map_verbs.hpp"
#include "semview/core/hash.hpp"
#include "semview/field/vdb_file.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/engine_choice.hpp"
#include "semview/raycast/scene.hpp"
#include "site_options.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

using nlohmann::ordered_json;

struct Options {
  std::string map;
  map::LoadOptions load;
  std::string engine;
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

ordered_json numbers_json(const Eigen::Vector3d& point) {
  return {point.x(), point.y(), point.z()};
}

/// Of the volume of a fused map; a file that cannot be read leaves the map as good as it is.
ordered_json volume_json(const map::SemanticMap& map) {
  const auto summary = field::read_vdb_summary(map.volume);
  if (!summary) return {{"error", summary.error().message}};
  return {{"file", map.volume.string()},
          {"voxel_m", summary->shape.voxel_m},
          {"truncation_m", summary->shape.truncation_m},
          {"classes", summary->classes.size()},
          {"frames", summary->frames},
          {"skipped", summary->skipped},
          {"source", summary->source}};
}

std::string volume_text(const map::SemanticMap& map) {
  const ordered_json volume = volume_json(map);
  if (volume.contains("error")) return volume["error"].get<std::string>();
  return fmt::format("{}: voxels of {:g} m, truncated at {:g} m, {} frames, {} skipped",
                     map.volume.filename().string(),
                     volume["voxel_m"].get<double>(),
                     volume["truncation_m"].get<double>(),
                     volume["frames"].get<std::uint64_t>(),
                     volume["skipped"].get<std::uint64_t>());
}

ordered_json info_json(const map::SemanticMap& map,
                       const map::CellGrid& grid,
                       const raycast::EngineChoice& choice) {
  ordered_json info{{"id", map.id},
                    {"name", map.name},
                    {"fingerprint", to_hex(map.fingerprint)},
                    {"kind", map.columns() != nullptr ? "plan" : "mesh"},
                    {"engine", choice.engine->name()},
                    {"engine_reason", choice.reason},
                    {"ground_height_m", map.ground_height_m}};
  if (map.ceiling) info["ceiling_height_m"] = map.ceiling->height_m;
  const Box box = box_of(map);
  info["size_m"] = numbers_json(box.high - box.low);
  info["bounds_m"] = {{"min", numbers_json(box.low)}, {"max", numbers_json(box.high)}};
  if (const map::ColumnMap* columns = map.columns()) {
    info["pixels"] = {columns->columns(), columns->rows()};
    info["resolution_m"] = columns->resolution_m;
    info["origin"] = {columns->origin.x_m, columns->origin.y_m, columns->origin.yaw_rad};
    info["objects"] = map.objects.features;
    info["object_profiles"] = map.objects.profiles.size();
  } else if (const map::MeshGeometry* mesh = map.mesh()) {
    if (!map.volume.empty()) info["volume"] = volume_json(map);
    info["vertices"] = mesh->mesh.vertices.size();
    info["triangles"] = mesh->mesh.triangles.size();
  }
  info["free_cells"] = grid.free_count();
  info["free_parts"] = grid.components().size();
  info["classes"] = classes_json(map);
  return info;
}

void print_classes(const map::SemanticMap& map) {
  fmt::print("classes\n");
  for (const ordered_json& entry : classes_json(map)) {
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

void print_text(const map::SemanticMap& map,
                const map::CellGrid& grid,
                const raycast::EngineChoice& choice) {
  const auto line = [](const char* key, const std::string& value) {
    fmt::print("{:<12} {}\n", key, value);
  };
  line("id", map.id);
  line("name", map.name);
  line("fingerprint", to_hex(map.fingerprint));
  line("engine", fmt::format("{} ({})", choice.engine->name(), choice.reason));
  if (const map::ColumnMap* columns = map.columns()) {
    line("plan",
         fmt::format("{} x {} pixels of {:g} m",
                     columns->columns(),
                     columns->rows(),
                     columns->resolution_m));
    line("origin",
         fmt::format("({:g}, {:g}) m, {:g} degrees",
                     columns->origin.x_m,
                     columns->origin.y_m,
                     deg_from_rad(columns->origin.yaw_rad)));
    if (map.objects.features > 0) {
      line("objects",
           fmt::format("{}, in {} profiles of their own",
                       map.objects.features,
                       map.objects.profiles.size()));
    }
  } else {
    const map::TriangleMesh& mesh = map.mesh()->mesh;
    line("mesh",
         fmt::format("{} triangles, {} vertices", mesh.triangles.size(), mesh.vertices.size()));
    if (!map.volume.empty()) line("volume", volume_text(map));
  }
  const Box box = box_of(map);
  const Eigen::Vector3d size_m = box.high - box.low;
  line(
      "size",
      fmt::format(
          "{:.2f} x {:.2f} x {:.2f} m (width, depth, height)", size_m.x(), size_m.y(), size_m.z()));
  line("bounds",
       fmt::format("x {:.2f} to {:.2f}, y {:.2f} to {:.2f}, z {:.2f} to {:.2f} m",
                   box.low.x(),
                   box.high.x(),
                   box.low.y(),
                   box.high.y(),
                   box.low.z(),
                   box.high.z()));
  line("ground", fmt::format("{:g} m", map.ground_height_m));
  line("ceiling", map.ceiling ? fmt::format("{:g} m", map.ceiling->height_m) : "open top");
  const std::size_t parts = grid.components().size();
  line("free cells",
       fmt::format("{} of 10 cm, in {} part{}", grid.free_count(), parts, parts == 1 ? "" : "s"));
  print_classes(map);
}

Result<raycast::EngineChoice> choose_engine(const map::SemanticMap& map,
                                            const map::CellGrid& grid,
                                            const Options& options) {
  SEMVIEW_TRY_STATUS(raycast::check_engine_name(options.engine));
  Result<raycast::Scene> scene = raycast::Scene::build(map);
  if (!scene) return with_context(std::move(scene), options.map);
  ViewProfile profile;
  profile.eye_height_m = options.eye_height_m;
  ThreadPool pool;
  return raycast::choose_engine(options.engine,
                                {map.id,
                                 map.classes,
                                 map.columns(),
                                 std::make_shared<const raycast::Scene>(*std::move(scene)),
                                 grid,
                                 map.ground_height_m},
                                profile,
                                pool);
}

Status show(const Options& options) {
  SEMVIEW_TRY(const map::SemanticMap map, map::load_map(options.map, options.load));
  SEMVIEW_TRY(const map::CellGrid grid, cell_grid_of(map, options.eye_height_m));
  SEMVIEW_TRY(const raycast::EngineChoice choice, choose_engine(map, grid, options));
  if (options.json) {
    const ordered_json info = info_json(map, grid, choice);
    fmt::print("{}\n", info.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print_text(map, grid, choice);
  }
  return {};
}

}  // namespace

void add_map_info(CLI::App& map, int& exit_code) {
  CLI::App* verb = map.add_subcommand(
      "info", "Say what a map is: id, name, fingerprint, size, classes, free cells, engine.");
  const auto options = std::make_shared<Options>();
  verb->add_option("MAP", options->map, "Map folder, map.yaml, .glb or .vdb file")->required();
  add_engine_option(*verb, options->engine);
  verb->add_option("--eye-height", options->eye_height_m, "Metres above the ground")
      ->check(CLI::Range(0.05, 100.0))
      ->capture_default_str();
  add_nearest_colour(*verb, options->load);
  verb->add_flag("--json", options->json, "Print it as JSON");
  verb->footer("Example: semview map info maps/duplex_level1 --json");
  verb->callback([options, &exit_code] { exit_code = report(show(*options)); });
}

}  // namespace semview::cli
