// SPDX-License-Identifier: Apache-2.0
#include "semview/map/mesh_map_reader.hpp"

namespace semview::map::detail {
namespace {

void add_unread(const std::filesystem::path& path, MapReport& report) {
  MapProblem problem = file_problem(Severity::kError, path, "mesh maps cannot be read yet");
  problem.code = ErrorCode::kUnimplemented;
  report.problems.push_back(std::move(problem));
}

}  // namespace

std::optional<MeshGeometry> read_mesh(const MapFile& file, MapReport& report) {
  add_unread(file.path, report);
  return std::nullopt;
}

std::optional<SemanticMap> read_bare_glb(const std::filesystem::path& path, MapReport& report) {
  add_unread(path, report);
  return std::nullopt;
}

}  // namespace semview::map::detail
