// SPDX-License-Identifier: Apache-2.0
/// What stands over one pixel of a plan: a stack of slabs.
#pragma once

#include <vector>

#include "semview/semantics/class_table.hpp"

namespace semview {

/// A solid layer of one class, z_min_m < z_max_m, metres in frame `map`.
struct Slab {
  double z_min_m = 0.0;
  double z_max_m = 0.0;
  ClassId label = kNoHit;

  bool operator==(const Slab&) const = default;
};

/// The column over a pixel: slabs from low to high without overlap, cut at ground and ceiling.
struct ColumnProfile {
  bool outside = false;     ///< not part of the building: no slab, no ground, no ceiling
  bool passable = false;    ///< a robot may stand here although a slab is in its way (an open door)
  ClassId ground = kNoHit;  ///< class of the ground's surface under the slabs
  std::vector<Slab> slabs;

  bool operator==(const ColumnProfile&) const = default;

  /// True if a slab shares more than a face with the open interval (low_m, high_m).
  bool reaches_into(double low_m, double high_m) const {
    for (const Slab& slab : slabs) {
      if (slab.z_min_m < high_m && slab.z_max_m > low_m) return true;
    }
    return false;
  }
};

}  // namespace semview
