// SPDX-License-Identifier: Apache-2.0
/// Label and range images as a camera might have photographed them: plain materials and light.
#pragma once

#include <functional>

#include <Eigen/Core>

#include "semview/geometry/image.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/view/column_view.hpp"

namespace semview::picture {

/// The ray of a pixel, x right or ahead and z up as the caller's frame is, of the length by which a
/// distance is to be multiplied: 1 of a panorama's ranges, to z = 1 of a pinhole's depths.
using RayOfPixel = std::function<Eigen::Vector3d(int row, int column)>;

/// Paints each surface in the plain material of its class (oak floor, white ceiling, bright
/// window), lit by how it faces the light, with a little grain: a demonstration of what
/// segmentation does, not a renderer. Equal images make equal bytes.
/// @param distances_m  of the size of `labels`; +∞ is sky
RgbImage draw_shaded(const LabelImage& labels,
                     const RangeImage& distances_m,
                     const ClassTable& classes,
                     const RayOfPixel& ray);

}  // namespace semview::picture
