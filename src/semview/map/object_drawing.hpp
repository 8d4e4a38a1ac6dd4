// SPDX-License-Identifier: Apache-2.0
/// Puts objects into a drawn plan. Inside the module only.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "semview/map/column_builder.hpp"
#include "semview/map/map_problem.hpp"
#include "semview/map/object_rules.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::map::detail {

/// The plan that objects are put into: its columns hold one profile for each entry of `drawn`.
struct ObjectPlan {
  ColumnMap& columns;
  std::span<const ClassId> drawn;  ///< the class of each profile; `kNoHit` for outside
  const std::vector<MapClass>& classes;
  const ClassTable& table;
  const Storey& storey;
};

/// Puts one object after the other into the plan: a pixel whose centre lies inside becomes of its
/// class and heights, unless it is outside or `over` leaves out the class that it has by then.
/// New profiles are those that a pixel has in the end, in the order of the first pixel of each; one
/// that is equal to another is that one. Adds to `report` which objects change nothing.
/// @return the profiles after those of `drawn`, as in `PlanObjects`.
/// docs/formats/map_bundle.md#objects
std::vector<MapClass> draw_objects(std::span<const ObjectClass> objects,
                                   const std::filesystem::path& path,
                                   const ObjectPlan& plan,
                                   MapReport& report);

}  // namespace semview::map::detail
