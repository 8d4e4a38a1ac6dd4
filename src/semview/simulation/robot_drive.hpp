// SPDX-License-Identifier: Apache-2.0
/// A differential-drive robot that follows a line.
#pragma once

#include <span>
#include <vector>

#include "semview/io/trajectory.hpp"
#include "semview/simulation/path_planner.hpp"

namespace semview::simulation {

struct DriveConfig {
  double max_speed_mps = 0.5;
  double max_turn_radps = 1.0;
  double max_acceleration_mps2 = 0.5;
  double max_turn_acceleration_radps2 = 2.5;
  double lookahead_m = 0.25;  ///< the point of the line that the robot steers for
  double tick_s = 0.02;
};

/// One pose a tick from standing at the line's first point, looking along it, until the line's end
/// or `length_m` of way, whichever is first. Turns on the spot where the line turns sharply.
std::vector<io::StampedPose2> drive(std::span<const Point2> line,
                                    double length_m,
                                    const DriveConfig& config);

}  // namespace semview::simulation
