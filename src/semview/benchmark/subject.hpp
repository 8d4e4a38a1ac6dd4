// SPDX-License-Identifier: Apache-2.0
/// A map with everything that the measurements need of it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "semview/benchmark/office_plan.hpp"
#include "semview/core/result.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/map/triangle_mesh.hpp"
#include "semview/raycast/column_scene.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/scene.hpp"

namespace semview::benchmark {

inline constexpr double kEyeHeight_m = 1.2;

struct Subject {
  std::string name;                  ///< for people: "office 5 cm"
  std::optional<OfficePlan> office;  ///< what it was drawn by, if it was generated
  std::shared_ptr<const map::SemanticMap> map;
  map::TriangleMesh mesh;
  std::shared_ptr<const raycast::Scene> scene;
  std::shared_ptr<const raycast::ColumnScene> columns;  ///< of a drawn map
  map::CellGrid cells;
  double mesh_s = 0.0;     ///< from a drawing to triangles
  double scene_s = 0.0;    ///< from triangles to a scene
  double columns_s = 0.0;  ///< from a drawing to columns

  double eye_z_m() const { return map->ground_height_m + kEyeHeight_m; }
  /// `count` different free cells with an eye, spread at random, the same ones always.
  std::vector<CellIndex> sample(std::size_t count) const;
  /// The runs seen, by columns where the map is drawn.
  ColumnView runs(const raycast::PanoramaRequest& request) const;
  /// From the cell's centre at yaw 0.
  raycast::PanoramaRequest request(const CellIndex& cell, const PanoramaCamera& camera) const;
};

/// @errors kInvalidArgument: a map that cannot be cast, or with no free cell.
Result<std::shared_ptr<const Subject>> prepare_subject(std::string name, map::SemanticMap map);
Result<std::shared_ptr<const Subject>> prepare_subject(std::string name, const OfficePlan& office);

/// Panoramas of -45° to 45° with four times as many columns as rows.
PanoramaCamera camera_of(int columns);

}  // namespace semview::benchmark
