// SPDX-License-Identifier: Apache-2.0
/// Angles: radians inside, degrees only at file and command-line edges.
#pragma once

#include <cmath>
#include <numbers>

namespace semview {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTwoPi = 2.0 * std::numbers::pi;

constexpr double rad_from_deg(double angle_deg) { return angle_deg * (kPi / 180.0); }
constexpr double deg_from_rad(double angle_rad) { return angle_rad * (180.0 / kPi); }

/// The same direction in (-π, π]; `angle_rad` must be finite.
inline double wrap_angle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, kTwoPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

}  // namespace semview
