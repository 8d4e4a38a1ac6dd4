// SPDX-License-Identifier: Apache-2.0
/// What a pinhole camera sees, in labels and depths.
#pragma once

#include <Eigen/Geometry>

#include "semview/core/result.hpp"
#include "semview/geometry/pinhole_camera.hpp"
#include "semview/raycast/scene.hpp"
#include "semview/view/column_view.hpp"

namespace semview::raycast {

inline constexpr int kMaxPinholeColumns = kMaxPinholeSide_px;
inline constexpr int kMaxPinholeRows = kMaxPinholeSide_px;

struct PinholeRequest {
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();  ///< optical frame
  PinholeCamera camera = {};
};

/// Both images have camera.rows × camera.columns pixels. Depth is z in the optical frame, not the
/// length of the ray. Where the ray meets nothing: `kNoHit` and +∞.
struct PinholeView {
  LabelImage labels;
  RangeImage depths_m;
};

/// @errors kInvalidArgument: a transform that is not finite, not a rotation, or farther than
/// `PoseGrid::kMaxCoordinate_m`; columns or rows below 1 or above the limits here; focal lengths
/// not in [1, 1e6] px; a principal point not finite or beyond 1e6 px. `Error::field` names the
/// field.
Status validate(const PinholeRequest& request);

/// Casts one ray through each pixel's centre and keeps the nearest surface; surfaces that the
/// eye touches are seen as in `render_panorama`.
/// @param request  must pass `validate`.
/// @threads Safe to call from several threads on one scene.
PinholeView render_pinhole(const Scene& scene, const PinholeRequest& request);

}  // namespace semview::raycast
