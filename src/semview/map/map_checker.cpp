// SPDX-License-Identifier: Apache-2.0
#include "semview/map/map_checker.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/map/map_reader.hpp"
#include "semview/map/occupancy.hpp"

namespace semview::map {
namespace {

using Path = std::filesystem::path;

Path file_of(const Path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored) ? path / "map.yaml" : path;
}

/// The file that free space is a matter of.
Path geometry_file(const SemanticMap& map) {
  return map.mesh() != nullptr ? map.mesh()->file : map.drawing;
}

std::optional<PixelIndex> first_pixel(const Image<std::uint8_t>& image, std::uint8_t grey) {
  const auto pixels = image.pixels();
  const auto found = std::find(pixels.begin(), pixels.end(), grey);
  if (found == pixels.end()) return std::nullopt;
  const int at = static_cast<int>(found - pixels.begin());
  return PixelIndex{at / image.columns(), at % image.columns()};
}

MapProblem no_space_drawn(const SemanticMap& map, const ColumnMap& columns, double eye_height_m) {
  MapProblem problem = file_problem(Severity::kError, geometry_file(map), {}, {});
  const Image<std::uint8_t> occupancy = occupancy_image(columns, eye_height_m);
  if ((problem.pixel = first_pixel(occupancy, kFreeGrey))) {
    problem.message =
        "there is no free space: what is free begins here, but nowhere does it cover the centre of "
        "a 10 cm cell";
    problem.remedy =
        fmt::format("is the resolution of {} m per pixel right?", columns.resolution_m);
  } else if ((problem.pixel = first_pixel(occupancy, kOccupiedGrey))) {
    problem.message = fmt::format(
        "there is no free space: from here on every pixel inside the building has something "
        "between 0.05 m above the ground and the eye at {} m",
        eye_height_m);
    problem.remedy = fmt::format("draw {}, or mark as passable what a robot drives through",
                                 map.classes.name(map.ground_label));
  } else {
    problem.message = "there is no free space: every pixel is outside";
    problem.remedy = fmt::format("draw {}", map.classes.name(map.ground_label));
  }
  return problem;
}

MapProblem no_space_in_mesh(const SemanticMap& map, double eye_height_m) {
  float lowest = std::numeric_limits<float>::infinity();
  float highest = -lowest;
  for (const Eigen::Vector3f& vertex : map.mesh()->mesh.vertices) {
    lowest = std::min(lowest, vertex.z());
    highest = std::max(highest, vertex.z());
  }
  return file_problem(
      Severity::kError,
      geometry_file(map),
      fmt::format("there is no free space: nowhere does an eye {} m above the ground see a surface "
                  "within 0.05 m of the ground's height {}; the mesh reaches from z = {:.2f} to "
                  "{:.2f}",
                  eye_height_m,
                  map.ground_height_m,
                  lowest,
                  highest),
      "give the z of the storey's floor as `ground: {height: ...}` in map.yaml");
}

MapProblem no_view(const SemanticMap& map, double eye_height_m) {
  const std::string ceiling =
      map.ceiling ? fmt::format(", below the ceiling at {} m", map.ceiling->height_m) : "";
  return file_problem(
      Severity::kError,
      geometry_file(map),
      fmt::format("a camera {} m above the ground would be in or above something everywhere",
                  eye_height_m),
      fmt::format("is --eye-height right? It must leave room over the floor{}", ceiling));
}

MapProblem space_in_parts(const CellGrid& grid,
                          const std::vector<GridComponent>& parts,
                          const SemanticMap& map) {
  const GridComponent& largest_other = parts[1];
  const Pose2 center = PoseGrid::center(largest_other.first);
  MapProblem problem = file_problem(
      Severity::kWarning,
      geometry_file(map),
      fmt::format("{} of {} free cells, in {} part{}, cannot be reached from the largest part; the "
                  "largest of them has {} cell{} and begins at ({:.2f}, {:.2f}) m",
                  grid.free_count() - parts[0].cells,
                  grid.free_count(),
                  parts.size() - 1,
                  parts.size() == 2 ? "" : "s",
                  largest_other.cells,
                  largest_other.cells == 1 ? "" : "s",
                  center.x_m,
                  center.y_m),
      "join them by a door (passable), or fill what no robot can enter");
  if (map.columns() != nullptr) problem.pixel = map.columns()->pixel_at(center.x_m, center.y_m);
  return problem;
}

}  // namespace

MapCheck check_map(const Path& path, const CheckOptions& options) {
  MapCheck check;
  check.map = detail::read_map(path, options.load, check.report);
  if (check.map && check.map->columns() != nullptr) {
    const CellGrid grid = build_cell_grid(*check.map->columns(), options.eye_height_m);
    check_free_space(grid, *check.map, options.eye_height_m, check.report);
  }
  sort_by_place(check.report);
  return check;
}

void check_free_space(const CellGrid& grid,
                      const SemanticMap& map,
                      double eye_height_m,
                      MapReport& report) {
  const std::vector<GridComponent> parts = grid.components();
  if (parts.empty()) {
    report.problems.push_back(map.columns() != nullptr
                                  ? no_space_drawn(map, *map.columns(), eye_height_m)
                                  : no_space_in_mesh(map, eye_height_m));
    return;
  }
  if (!grid.any_view()) report.problems.push_back(no_view(map, eye_height_m));
  if (parts.size() > 1) {
    report.problems.push_back(space_in_parts(grid, parts, map));
  }
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
