// SPDX-License-Identifier: Apache-2.0
#include "semview/map/mesh_map_reader.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>
#include <vector>

#include "semview/map/class_rules.hpp"
#include "semview/map/gltf_read.hpp"
#include "semview/map/map_limits.hpp"

namespace semview::map::detail {
namespace {

using Path = std::filesystem::path;

/// An id made of a file's name: other characters become `_`.
std::string id_of(const Path& file) {
  std::string id = file.stem().string().substr(0, kMaxMapIdLength);
  for (char& c : id) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const bool usable = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (!usable) c = '_';
  }
  return id;
}

}  // namespace

std::optional<MeshGeometry> read_mesh(const MapFile& file, MapReport& report) {
  if (file.mesh.text.empty()) return std::nullopt;
  const Path path = file.path.parent_path() / file.mesh.text;
  Result<LabelledMesh> labelled = read_glb(path);
  if (!labelled) {
    MapProblem problem = problem_of(path, labelled.error());
    if (problem.code == ErrorCode::kNotFound) {
      problem.remedy = "put the mesh there, or write its name as `mesh:`";
    }
    report.problems.push_back(std::move(problem));
    return std::nullopt;
  }
  std::vector<bool> drawn;
  std::vector<std::string> names;
  for (const ClassField& field : file.classes) {
    names.push_back(field.value.name);
    drawn.push_back(std::binary_search(
        labelled->class_names.begin(), labelled->class_names.end(), field.value.name));
  }
  if (report.has_errors()) return std::nullopt;
  check_unused(file, drawn, report);
  Result<TriangleMesh> mesh = relabel(*std::move(labelled), ClassTable(std::move(names)));
  if (!mesh) {
    report.problems.push_back(problem_of(path, mesh.error()));
    return std::nullopt;
  }
  return MeshGeometry{*std::move(mesh), path};
}

std::optional<SemanticMap> read_bare_glb(const Path& path, MapReport& report) {
  Result<LabelledMesh> labelled = read_glb(path);
  if (!labelled) {
    report.problems.push_back(problem_of(path, labelled.error()));
    return std::nullopt;
  }
  SemanticMap map;
  map.id = id_of(path);
  map.name = path.stem().string();
  map.directory = path.parent_path();
  map.classes = ClassTable(labelled->class_names);
  for (const std::string& name : labelled->class_names) {
    MapClass details;
    details.name = name;
    map.class_details.push_back(std::move(details));
  }
  map.ground_label = map.classes.id("floor").value_or(kNoHit);
  map.geometry = MeshGeometry{std::move(labelled->mesh), path};
  return map;
}

}  // namespace semview::map::detail
