// SPDX-License-Identifier: Apache-2.0
/// From the triangles that a panorama's rays meet to runs with planes. Internal to this module.
#pragma once

#include <cstdint>

#include "semview/geometry/image.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/scene.hpp"
#include "semview/view/column_view.hpp"

namespace semview::raycast {

/// What the pixels of a panorama show, one triangle's index each; `kNoTriangle` where there is
/// none.
using TriangleImage = Image<std::uint32_t>;
inline constexpr std::uint32_t kNoTriangle = ~0U;

/// Pixels of one class lie on one surface while its plane gives their range to within this.
inline constexpr double kSameSurface_m = 1e-4;

/// The runs of a panorama with the plane of each.
///
/// A run takes the plane of its first pixel's triangle, computed from the triangle's corners, so
/// that every rebuilt range is within `kSameSurface_m` of the range to the pixel's own triangle.
/// @param triangles  rows × columns of `request.camera`
ColumnView runs_with_planes(const Scene& scene,
                            const PanoramaRequest& request,
                            const TriangleImage& triangles);

}  // namespace semview::raycast
