// SPDX-License-Identifier: Apache-2.0
/// A distorted plan: drawn metres = A · true metres.
#pragma once

#include <algorithm>
#include <cmath>
#include <compare>

#include <Eigen/Core>

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

  /// A true unit direction turned into the drawn map and not normalised again: a ray's parameter
  /// stays the true range, and a heading stays a shift of columns.
  Eigen::Vector3d apply(const Eigen::Vector3d& direction) const {
    return {a * direction.x(), k * direction.x() + b * direction.y(), direction.z()};
  }
};

/// How finely distortions are told apart where views are cached: scales by steps of their
/// logarithm, shears by steps.
inline constexpr double kAffineStep = 0.02;

/// The nearest distortion of the grid of `kAffineStep`, within the ranges above; the identity is on
/// it. Equal steps give equal bits on every machine.
inline MapAffine on_affine_grid(const MapAffine& affine) {
  const auto scale = [](double value) {
    const double steps = std::round(std::log(value) / kAffineStep);
    return steps == 0.0 ? 1.0 : std::min(5.0, std::max(0.2, std::exp(steps * kAffineStep)));
  };
  const double shear = std::round(affine.k / kAffineStep) * kAffineStep;
  return {scale(affine.a), scale(affine.b), std::min(2.0, std::max(-2.0, shear)) + 0.0};
}

}  // namespace semview
