// SPDX-License-Identifier: Apache-2.0
/// A floor plan to draw on.
#pragma once

#include "semview/geometry/image.hpp"
#include "semview/geometry/pose2.hpp"

namespace semview::picture {

/// A coloured plan and its place in frame `map`, as in a ROS map: `origin` is the pose of the
/// lower-left corner of the lower-left pixel, row 0 has the largest y.
struct Plan {
  RgbImage image;
  double resolution_m = 0.05;  ///< a pixel's side
  Pose2 origin;
};

}  // namespace semview::picture
