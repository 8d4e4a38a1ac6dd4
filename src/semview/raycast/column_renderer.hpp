// SPDX-License-Identifier: Apache-2.0
/// What is seen from a pose in an extruded plan, without a ray in 3D.
#pragma once

#include "semview/raycast/column_scene.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/view/column_view.hpp"

namespace semview::raycast {

/// The runs of `render_panorama(scene, request)`; with `ranges` each carries its plane.
///
/// All rays of a panorama's column pass the same pixels of the plan. So one walk gives the profiles
/// and the distances between which they lie; a slab over such a stretch covers one interval of
/// tangents of elevation, and what is nearer hides what is farther.
/// @param request  must pass `validate`.
/// @threads Safe to call from several threads on one scene.
ColumnView render_column_view(const ColumnScene& scene,
                              const PanoramaRequest& request,
                              bool ranges);

/// As `render_panorama` of the extruded plan, but for pixels whose ray meets an edge, and for an
/// eye inside a slab: it sees that slab at range 0.
Panorama render_panorama(const ColumnScene& scene, const PanoramaRequest& request);

}  // namespace semview::raycast
