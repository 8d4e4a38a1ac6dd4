// SPDX-License-Identifier: Apache-2.0
/// A drive through a building: random goals, joined by paths that keep off the walls.
#pragma once

#include <vector>

#include "semview/core/random.hpp"
#include "semview/core/result.hpp"
#include "semview/simulation/free_space.hpp"

namespace semview::simulation {

struct Point2 {
  double x_m = 0.0;
  double y_m = 0.0;
};

struct TourConfig {
  double length_m = 15.0;        ///< at least this long; > 0
  double min_clearance_m = 0.2;  ///< the robot's radius; in (0, FreeSpace::kHorizon_m)
  /// Up to this clearance a path is led away from obstacles: in it the way counts up to four times
  /// as long.
  double comfort_m = 0.6;
  double min_leg_m = 3.0;  ///< goals are at least this far apart along the way, where there is room
};

/// A smooth line from a random start to one random goal after the other, densely sampled (a few
/// centimetres), off the grid, nowhere nearer to an obstacle than `min_clearance_m`.
///
/// @errors kFailedPrecondition: no place with that clearance, or nowhere to go from the largest
/// one.
Result<std::vector<Point2>> plan_tour(const FreeSpace& space, const TourConfig& config, Rng& rng);

}  // namespace semview::simulation
