// SPDX-License-Identifier: Apache-2.0
/// Lists everything that is wrong with a map, not only the first thing.
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "semview/map/cell_grid.hpp"
#include "semview/map/map_problem.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::map {

struct CheckOptions {
  LoadOptions load;
  double eye_height_m = 1.2;  ///< above the ground; decides what is free
};

struct MapCheck {
  MapReport report;
  std::optional<SemanticMap> map;  ///< if it could be loaded
};

/// Checks the map at `path` (see `load_map`, which reads by the same code). @threads safe
MapCheck check_map(const std::filesystem::path& path, const CheckOptions& options = {});

/// Adds to `report` what is wrong with free space: none (an error), or parts that cannot be reached
/// from each other (a warning), with the drawing's pixel or the mesh's file. `check_map` does so
/// for drawn maps; the grid of a mesh takes ray casting, which this module does not have.
void check_free_space(const CellGrid& grid,
                      const SemanticMap& map,
                      double eye_height_m,
                      MapReport& report);

/// Adds an error to each map whose id another one before it has: ids are unique in a server.
void check_unique_ids(std::span<const std::filesystem::path> paths, std::span<MapCheck> checks);

}  // namespace semview::map
