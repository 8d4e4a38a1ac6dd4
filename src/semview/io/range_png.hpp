// SPDX-License-Identifier: Apache-2.0
/// Ranges and depths as 16-bit images.
#pragma once

#include <cstdint>

#include "semview/geometry/image.hpp"
#include "semview/view/column_view.hpp"

namespace semview::io {

/// Whole millimetres, to the nearest: 0 is nothing hit (+∞), 65535 is 65.535 m or more. What is
/// nearer than half a millimetre is 1, since 0 is taken.
Image<std::uint16_t> millimetres(const RangeImage& ranges_m);

/// The depths of a 16-bit image of whole millimetres; 0, not measured, stays 0.
Image<float> depth_m(const Image<std::uint16_t>& millimetres);

}  // namespace semview::io
