// SPDX-License-Identifier: Apache-2.0
/// The shape of a map's cached views.
#pragma once

#include "semview/core/result.hpp"
#include "semview/geometry/panorama_camera.hpp"

namespace semview {

/// Panorama shape and eye height; part of every cache key.
struct ViewProfile {
  PanoramaCamera camera = {};
  double eye_height_m = 1.2;  ///< above the map's ground
  bool ranges = false;        ///< views carry a plane a run: see `RunPlane`

  bool operator==(const ViewProfile&) const = default;
};

inline constexpr int kMaxPanoramaColumns = 3600;
inline constexpr int kMaxPanoramaRows = 1024;

/// @errors kInvalidArgument: columns not a multiple of 120 or above `kMaxPanoramaColumns`; rows
/// outside 1..`kMaxPanoramaRows`; elevations not finite, not in [-90°, 90°] or not increasing; eye
/// height not in (0, 100] m. `Error::field` names the field.
Status validate(const ViewProfile& profile);

}  // namespace semview
