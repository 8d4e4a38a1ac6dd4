// SPDX-License-Identifier: Apache-2.0
/// Planar poses, as in REP-103: x forward, y left, yaw counter-clockwise.
#pragma once

#include <cmath>

#include "semview/geometry/angle.hpp"

namespace semview {

/// A planar pose, read as a transform: `map_from_robot`.
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;  ///< in (-π, π]

  bool operator==(const Pose2&) const = default;
};

/// Composition: `a_from_b * b_from_c` is `a_from_c`.
inline Pose2 operator*(const Pose2& a_from_b, const Pose2& b_from_c) {
  const double c = std::cos(a_from_b.yaw_rad);
  const double s = std::sin(a_from_b.yaw_rad);
  return {a_from_b.x_m + c * b_from_c.x_m - s * b_from_c.y_m,
          a_from_b.y_m + s * b_from_c.x_m + c * b_from_c.y_m,
          wrap_angle(a_from_b.yaw_rad + b_from_c.yaw_rad)};
}

inline Pose2 inverse(const Pose2& a_from_b) {
  const double c = std::cos(a_from_b.yaw_rad);
  const double s = std::sin(a_from_b.yaw_rad);
  return {-c * a_from_b.x_m - s * a_from_b.y_m,
          s * a_from_b.x_m - c * a_from_b.y_m,
          wrap_angle(-a_from_b.yaw_rad)};
}

/// Distance of the positions in metres.
inline double distance_m(const Pose2& a, const Pose2& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

inline bool is_finite(const Pose2& pose) {
  return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.yaw_rad);
}

}  // namespace semview
