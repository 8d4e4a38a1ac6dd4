// SPDX-License-Identifier: Apache-2.0
/// A distorted plan: drawn metres = A · true metres.
#pragma once

#include <Eigen/Core>

namespace semview {

/// A = [[a, 0], [k, b]] maps true metres to metres as drawn: `a` and `b` scale the axes, `k` shears
/// y by x. A rotation would only be another heading. The default leaves the map as it is.
struct MapAffine {
  double a = 1.0;  ///< in [0.2, 5]
  double b = 1.0;  ///< in [0.2, 5]
  double k = 0.0;  ///< in [-2, 2]

  bool operator==(const MapAffine&) const = default;

  /// A true unit direction turned into the drawn map and not normalised again: a ray's parameter
  /// stays the true range, and a heading stays a shift of columns.
  Eigen::Vector3d apply(const Eigen::Vector3d& direction) const {
    return {a * direction.x(), k * direction.x() + b * direction.y(), direction.z()};
  }
};

}  // namespace semview
