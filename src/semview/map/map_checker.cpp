// SPDX-License-Identifier: Apache-2.0
#include "semview/map/map_checker.hpp"

#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/map/map_reader.hpp"

namespace semview::map {
namespace {

using Path = std::filesystem::path;

Path file_of(const Path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored) ? path / "map.yaml" : path;
}

}  // namespace

MapCheck check_map(const Path& path, const CheckOptions& options) {
  MapCheck check;
  check.map = detail::read_map(path, options.load, check.report);
  if (check.map && check.map->columns() != nullptr) {
    const CellGrid grid = build_cell_grid(*check.map->columns(), options.eye_height_m);
    check_free_space(grid, check.map->columns(), path, check.report);
  }
  return check;
}

void check_free_space(const CellGrid& grid,
                      const ColumnMap* columns,
                      const Path& path,
                      MapReport& report) {
  const Path file = file_of(path);
  const std::vector<GridComponent> parts = grid.components();
  if (parts.empty()) {
    report.problems.push_back(file_problem(
        Severity::kError,
        file,
        "there is no free space: no 10 cm cell is inside the building without an obstacle between "
        "the ground and the eye",
        "draw floor; a slab between 0.05 m above the ground and the eye blocks a cell"));
    return;
  }
  if (parts.size() == 1) return;
  const GridComponent& largest_other = parts[1];
  const Pose2 center = PoseGrid::center(largest_other.first);
  MapProblem problem = file_problem(
      Severity::kWarning,
      file,
      fmt::format("{} of {} free cells, in {} part{}, cannot be reached from the largest part; the "
                  "largest of them has {} cells and begins at ({:.2f}, {:.2f}) m",
                  grid.free_count() - parts[0].cells,
                  grid.free_count(),
                  parts.size() - 1,
                  parts.size() == 2 ? "" : "s",
                  largest_other.cells,
                  center.x_m,
                  center.y_m),
      "join them by a door (passable), or fill what no robot can enter");
  if (columns != nullptr) problem.pixel = columns->pixel_at(center.x_m, center.y_m);
  report.problems.push_back(std::move(problem));
}

void check_unique_ids(std::span<const Path> paths, std::span<MapCheck> checks) {
  SEMVIEW_CHECK(paths.size() == checks.size());
  std::map<std::string, std::size_t> owners;
  for (std::size_t i = 0; i < checks.size(); ++i) {
    if (!checks[i].map) continue;
    const auto [owner, is_new] = owners.emplace(checks[i].map->id, i);
    if (is_new) continue;
    checks[i].report.problems.push_back(file_problem(
        Severity::kError,
        file_of(paths[i]),
        fmt::format(
            "id {} is also that of {}", checks[i].map->id, file_of(paths[owner->second]).string()),
        "ids are unique in a server; give one of them another `id:`"));
  }
}

}  // namespace semview::map
