// SPDX-License-Identifier: Apache-2.0
#include "volume_bundle.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/core/thread_pool.hpp"
#include "semview/field/volume_mesh.hpp"
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

}  // namespace

Result<BundleFindings> write_volume_bundle(const std::filesystem::path& folder,
                                           const std::filesystem::path& volume_file,
                                           const field::SemanticVolume& volume) {
  ThreadPool pool;
  SEMVIEW_TRY(const map::TriangleMesh mesh, field::mesh_of(volume, {}, pool));
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
  return BundleFindings{mesh.triangles.size(), ground_height_m};
}

}  // namespace semview::cli
