// SPDX-License-Identifier: Apache-2.0
#include "volume_bundle.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/core/thread_pool.hpp"
#include "semview/field/floor_height.hpp"
#include "semview/io/text_file.hpp"
#include "semview/io/yaml_document.hpp"
#include "semview/map/gltf_write.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::cli {
namespace {

/// The class of triangles near which no label was counted.
constexpr const char* kUnlabelled = "unlabelled";

std::string map_yaml(const std::filesystem::path& folder,
                     const std::filesystem::path& volume_file,
                     const map::SemanticMap& map,
                     const map::TriangleMesh& mesh,
                     bool has_floor,
                     double ground_height_m) {
  const std::set<ClassId> drawn(mesh.labels.begin(), mesh.labels.end());
  std::string text =
      fmt::format("semview:\n  format: 1\n  name: {}\n  mesh: mesh.glb\n  volume: {}\n",
                  io::quoted_yaml(folder.filename().string()),
                  io::quoted_yaml(volume_file.string()));
  text += fmt::format("  ground: {{{}height: {:.3f}}}\n  classes:\n",
                      has_floor ? "class: floor, " : "",
                      ground_height_m);
  for (const ClassId id : drawn) {
    text += fmt::format("    - {{name: {}}}\n", io::quoted_yaml(map.classes.name(id)));
  }
  return text;
}

/// Does the map.yaml say `volume: <volume_file>`?
bool names_volume(const std::filesystem::path& map_yaml, const std::filesystem::path& volume_file) {
  const Result<io::YamlNode> document = io::read_yaml(map_yaml);
  if (!document) return false;
  const std::optional<io::YamlNode> ours = document->find("semview");
  const std::optional<io::YamlNode> volume =
      ours ? ours->find("volume") : std::optional<io::YamlNode>();
  return volume && volume->text().value_or("") == volume_file.string();
}

}  // namespace

Status check_volume_bundle(const std::filesystem::path& folder,
                           const std::filesystem::path& volume_file) {
  std::error_code ignored;
  const std::filesystem::path map_yaml = folder / "map.yaml";
  const auto refuse = [](const std::filesystem::path& file, const std::string& what) {
    return fail(Error{ErrorCode::kAlreadyExists,
                      fmt::format("{}: {}", file.string(), what),
                      {},
                      "name another folder: -o"});
  };
  if (std::filesystem::exists(map_yaml, ignored)) {
    if (names_volume(map_yaml, volume_file)) return {};
    return refuse(map_yaml, fmt::format("is a map that is not of {}", volume_file.string()));
  }
  // Of a fusion that was stopped there is the volume.
  const bool begun = std::filesystem::exists(folder / volume_file, ignored);
  if (!begun && std::filesystem::exists(folder / "mesh.glb", ignored)) {
    return refuse(folder / "mesh.glb", "is there already, and would be written over");
  }
  return {};
}

Result<BundleFindings> write_volume_bundle(const std::filesystem::path& folder,
                                           const std::filesystem::path& volume_file,
                                           const field::SemanticVolume& volume,
                                           const field::VolumeMeshConfig& surface) {
  ThreadPool pool;
  SEMVIEW_TRY(map::TriangleMesh mesh, field::mesh_of(volume, surface, pool));
  map::SemanticMap map;
  const auto known = volume.classes().names();
  std::vector<std::string> names(known.begin(), known.end());
  names.emplace_back(kUnlabelled);
  for (const std::string& name : names) {
    map::MapClass details;
    details.name = name;
    map.class_details.push_back(std::move(details));
  }
  map.classes = ClassTable(std::move(names));
  const ClassId floor = map.classes.id("floor").value_or(kNoHit);
  const bool has_floor = std::ranges::find(mesh.labels, floor) != mesh.labels.end();
  const double ground_height_m =
      field::floor_height_m(mesh, has_floor ? floor : kNoHit, volume.shape().voxel_m);
  SEMVIEW_TRY_STATUS(map::write_glb(map, mesh, folder / "mesh.glb"));
  // Last: a folder without it is no map.
  SEMVIEW_TRY_STATUS(io::write_text_file(folder / "map.yaml",
                                         map_yaml(std::filesystem::weakly_canonical(folder),
                                                  volume_file,
                                                  map,
                                                  mesh,
                                                  has_floor,
                                                  ground_height_m)));
  return BundleFindings{std::move(mesh), ground_height_m};
}

}  // namespace semview::cli
