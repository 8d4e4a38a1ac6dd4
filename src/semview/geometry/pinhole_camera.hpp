// SPDX-License-Identifier: Apache-2.0
/// The pinhole camera, optical frame: x right, y down, z forward.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "semview/geometry/pose2.hpp"

namespace semview {

inline constexpr int kMaxPinholeSide_px = 4096;  ///< rows or columns
inline constexpr double kMinFocalLength_px = 1.0;
inline constexpr double kMaxFocalLength_px = 1e6;
inline constexpr double kMaxPrincipalPoint_px = 1e6;  ///< in size, either coordinate

/// Intrinsics in pixels; pixel (row r, column c) has its centre at (u, v) = (c + 0.5, r + 0.5).
struct PinholeCamera {
  int columns = 640;
  int rows = 480;
  double fx_px = 525.0;
  double fy_px = 525.0;
  double cx_px = 320.0;
  double cy_px = 240.0;

  bool operator==(const PinholeCamera&) const = default;

  /// Direction through a pixel centre in the optical frame, scaled to z = 1, so that a ray's
  /// parameter is the depth.
  Eigen::Vector3d direction(int row, int column) const {
    return {(column + 0.5 - cx_px) / fx_px, (row + 0.5 - cy_px) / fy_px, 1.0};
  }
};

/// `map_from_camera` of a level camera at `eye_z_m` above z = 0 of the map, looking along the yaw
/// of `map_from_robot`.
Eigen::Isometry3d level_camera(const Pose2& map_from_robot, double eye_z_m);

}  // namespace semview
