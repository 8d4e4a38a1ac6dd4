// SPDX-License-Identifier: Apache-2.0
/// What a robot's RGB-D camera saw.
#pragma once

#include <Eigen/Geometry>

#include "semview/geometry/image.hpp"
#include "semview/geometry/pinhole_camera.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/view/column_view.hpp"

namespace semview {

/// One depth image with labels. Frame `base` has x forward, y left and z up from the ground under
/// the robot.
struct DepthObservation {
  ClassTable classes;    ///< the observer's own vocabulary, not the map's
  Image<float> depth_m;  ///< z in the optical frame; 0 or not finite: not measured
  LabelImage labels;     ///< ids of `classes`, or `kUnknown`; empty: all unknown
  PinholeCamera camera;
  Eigen::Isometry3d base_from_camera = Eigen::Isometry3d::Identity();  ///< optical frame
  double stamp_s = 0.0;
};

}  // namespace semview
