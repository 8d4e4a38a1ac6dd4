// SPDX-License-Identifier: Apache-2.0
/// Numbers as colours.
#pragma once

#include "semview/geometry/image.hpp"

namespace semview::picture {

/// The viridis colour map (Smith, van der Walt 2015): dark violet at 0, yellow at 1, even steps in
/// lightness. `share` is clamped to [0, 1].
Rgb viridis(double share);

/// White at 0, ever stronger blue up to 1, red down to -1; `share` is clamped to [-1, 1].
Rgb diverging(double share);

}  // namespace semview::picture
