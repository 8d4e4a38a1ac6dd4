// SPDX-License-Identifier: Apache-2.0
/// Which engine casts a map's views.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/column_map.hpp"
#include "semview/raycast/engine.hpp"
#include "semview/raycast/scene.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/view/view_profile.hpp"

namespace semview::raycast {

/// What is asked for where nothing is.
inline constexpr std::string_view kAutoEngine = "auto";

/// @errors kInvalidArgument, field `--engine`: not "auto" or the name of an engine.
Status check_engine_name(std::string_view name);

/// A map as engines take it.
struct EngineMap {
  std::string_view id;
  const ClassTable& classes;
  const map::ColumnMap* plan;          ///< null: a mesh
  std::shared_ptr<const Scene> scene;  ///< the mesh, or the extruded plan
  const map::CellGrid& cells;          ///< at the profile's eye height
  double ground_height_m;
};

struct EngineChoice {
  std::shared_ptr<const Engine> engine;
  std::string reason;  ///< a clause
};

/// The engine of that name, or for `kAutoEngine` columns where the map is a plan and Embree where
/// it is not. Before columns are taken by themselves they are compared with Embree (engine_check):
/// if they disagree anywhere the log says so in one line, and Embree stays.
/// @errors kInvalidArgument, field `--engine`: an unknown name; columns for a mesh.
/// @cost auto, of a plan: two small panoramas for each of some 64 to 150 cells.
Result<EngineChoice> choose_engine(std::string_view name,
                                   const EngineMap& map,
                                   const ViewProfile& profile,
                                   ThreadPool& pool);

}  // namespace semview::raycast
