// SPDX-License-Identifier: Apache-2.0
/// The building as it really is, which is not quite as it was drawn.
#pragma once

#include <span>

#include "semview/core/random.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/simulation/path_planner.hpp"

namespace semview::simulation {

struct WorldConfig {
  double height_error_m = 0.05;  ///< each object's faces stand up to this much higher or lower
  double missing_share = 0.2;    ///< probability that a piece of furniture is not there
};

/// A plan that differs from the one it was made of.
struct World {
  map::ColumnMap plan;
  int objects = 0;    ///< connected parts that have a face between ground and ceiling
  int furniture = 0;  ///< of these: what somebody could carry away
  int missing = 0;    ///< furniture that is not there
};

/// Moves heights and takes furniture away, object by object.
///
/// An object is a connected part of pixels with one profile. Its faces between ground and ceiling
/// move together, in steps of a quarter of `height_error_m`: table tops, sills and lintels, but not
/// walls. Furniture is what the map calls movable (`movable` > 0); in a map that calls nothing so,
/// whatever stands free: lower than 0.3 m below the ceiling, not passable, at most 6 m². A plan has
/// room for 256 different profiles: objects beyond that stay as drawn.
World vary_plan(const map::SemanticMap& drawn, const WorldConfig& config, Rng& rng);

/// Opens the doors that a robot drives through: every passable part within `reach_m` of the line
/// loses what would be in the robot's way. @return how many.
int open_doors(map::ColumnMap& plan,
               std::span<const Point2> line,
               double reach_m,
               double eye_height_m);

}  // namespace semview::simulation
