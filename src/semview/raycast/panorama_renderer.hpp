// SPDX-License-Identifier: Apache-2.0
/// What is seen from a pose, all around, in labels and ranges.
#pragma once

#include "semview/core/result.hpp"
#include "semview/geometry/affine.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/raycast/scene.hpp"
#include "semview/view/column_view.hpp"

namespace semview::raycast {

/// An exact pose: nothing is rounded to the grid.
struct PanoramaRequest {
  Pose2 map_from_robot = {};  ///< x, y where the eye is in the map as drawn; yaw in the true world
  double eye_z_m = 1.2;       ///< in frame `map`, so ground height plus eye height
  PanoramaCamera camera = {};
  MapAffine affine = {};  ///< from true to drawn metres; ranges are true metres
};

/// Both images have camera.rows × camera.columns pixels, orientation as in
/// docs/conventions.md#panorama. Where the ray meets nothing: `kNoHit` and +∞.
struct Panorama {
  LabelImage labels;
  RangeImage ranges_m;
};

/// @errors kInvalidArgument: a pose or height that is not finite or farther than
/// `PoseGrid::kMaxCoordinate_m`; columns or rows below 1 or above `kMaxPanoramaColumns`,
/// `kMaxPanoramaRows`; elevations not increasing within ±90°; an affine outside the limits of its
/// header. `Error::field` names the field.
Status validate(const PanoramaRequest& request);
Status validate(const MapAffine& affine);

/// Casts one ray through each pixel's centre and keeps the nearest surface.
///
/// An eye nearer than 0.1 mm to a surface, on whichever side, counts as standing in front of it: it
/// sees the surface at range 0 where it looks at it, and does not see it where it looks away.
/// @param request  must pass `validate`.
/// @threads Safe to call from several threads on one scene.
/// @cost O(pixels · log triangles); bench/raycast_bench.cpp.
/// @source Neubert et al. 2017, section III-A (there: the nearest point of a point cloud).
Panorama render_panorama(const Scene& scene, const PanoramaRequest& request);

/// The labels of `render_panorama` as runs; with `ranges` each run carries its plane.
ColumnView render_column_view(const Scene& scene,
                              const PanoramaRequest& request,
                              bool ranges = false);

/// `render_panorama` ray by ray: the twin that tests and the benchmark compare packets with.
Panorama render_panorama_single_rays(const Scene& scene, const PanoramaRequest& request);

}  // namespace semview::raycast
