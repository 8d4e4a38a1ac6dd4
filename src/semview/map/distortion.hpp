// SPDX-License-Identifier: Apache-2.0
/// Plans that are scaled and sheared, as hand-drawn ones are.
#pragma once

#include "semview/core/result.hpp"
#include "semview/geometry/affine.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::map {

/// The map with every point p of frame `map` moved to A·p; heights stay. A pixel of the result is
/// of the class of the pixel in which its centre lay before. The image is as large as it must be,
/// its axes those of frame `map`, its resolution that of `drawn`.
///
/// The fingerprint is that of the new content; what is outside of the old image is outside.
/// @errors kUnimplemented: a mesh map; kInvalidArgument: A outside of the ranges of `MapAffine`;
/// kResourceExhausted: an image above the limits of docs/formats/map_bundle.md.
/// @source Neubert et al. 2017, section IV-A, experiments 3 and 4
Result<SemanticMap> distort(const SemanticMap& drawn, const MapAffine& affine);

/// Where a place of the true map is in the distorted one: the position moves, and the yaw, which
/// belongs to the true world, stays.
inline Pose2 distort(const Pose2& pose, const MapAffine& affine) {
  return {affine.a * pose.x_m, affine.k * pose.x_m + affine.b * pose.y_m, pose.yaw_rad};
}

}  // namespace semview::map
