// SPDX-License-Identifier: Apache-2.0
/// A distorted plan: drawn metres = A · true metres.
#pragma once

#include <algorithm>
#include <cmath>
#include <compare>

#include <Eigen/Core>

#include "semview/geometry/pose2.hpp"

namespace semview {

/// A = [[a, 0], [k, b]] maps true metres to metres as drawn: `a` and `b` scale the axes, `k` shears
/// y by x. A rotation would only be another heading. The default leaves the map as it is.
struct MapAffine {
  double a = 1.0;  ///< in [0.2, 5]
  double b = 1.0;  ///< in [0.2, 5]
  double k = 0.0;  ///< in [-2, 2]

  bool operator==(const MapAffine&) const = default;
  auto operator<=>(const MapAffine&) const = default;

  bool is_identity() const { return *this == MapAffine{}; }

  /// Within the ranges above; NaN is not.
  bool in_range() const {
    const auto is_scale = [](double factor) { return factor >= 0.2 && factor <= 5.0; };
    return is_scale(a) && is_scale(b) && k >= -2.0 && k <= 2.0;
  }

  /// A true unit direction turned into the drawn map and not normalised again: a ray's parameter
  /// stays the true range, and a heading stays a shift of columns.
  Eigen::Vector3d apply(const Eigen::Vector3d& direction) const {
    return {a * direction.x(), k * direction.x() + b * direction.y(), direction.z()};
  }
};

/// `after` is `before` moved in true metres: where that leads in the drawn map.
inline Pose2 drawn_move(const Pose2& before, const Pose2& after, const MapAffine& affine) {
  const double x_m = after.x_m - before.x_m;
  const double y_m = after.y_m - before.y_m;
  return {before.x_m + affine.a * x_m, before.y_m + affine.k * x_m + affine.b * y_m, after.yaw_rad};
}

/// The way back, from drawn to true metres.
inline MapAffine inverse(const MapAffine& affine) {
  return {1.0 / affine.a, 1.0 / affine.b, -affine.k / (affine.a * affine.b) + 0.0};
}

/// How finely distortions are told apart where views are cached: scales by steps of their
/// logarithm, shears by steps.
inline constexpr double kAffineStep = 0.02;

/// A distortion on the grid of `kAffineStep`, in steps from the identity: how it travels.
struct AffineSteps {
  int a = 0;  ///< of ln a, within ±`kMostSteps`
  int b = 0;  ///< of ln b, within ±`kMostSteps`
  int k = 0;  ///< within ±`kMostShearSteps`

  static constexpr int kMostSteps = 80;        ///< ln 5 / 0.02, rounded down
  static constexpr int kMostShearSteps = 100;  ///< 2 / 0.02

  bool operator==(const AffineSteps&) const = default;
};

/// The nearest steps. `affine` must be in range.
inline AffineSteps affine_steps(const MapAffine& affine) {
  const auto steps = [](double value, int most) {
    return std::clamp(static_cast<int>(std::lround(value / kAffineStep)), -most, most);
  };
  return {steps(std::log(affine.a), AffineSteps::kMostSteps),
          steps(std::log(affine.b), AffineSteps::kMostSteps),
          steps(affine.k, AffineSteps::kMostShearSteps)};
}

inline MapAffine affine_of(const AffineSteps& steps) {
  const auto scale = [](int count) { return count == 0 ? 1.0 : std::exp(count * kAffineStep); };
  return {scale(steps.a), scale(steps.b), steps.k * kAffineStep};
}

/// The nearest distortion of the grid; the identity is on it. `affine` must be in range.
inline MapAffine on_affine_grid(const MapAffine& affine) { return affine_of(affine_steps(affine)); }

}  // namespace semview
