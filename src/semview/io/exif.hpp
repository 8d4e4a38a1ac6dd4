// SPDX-License-Identifier: Apache-2.0
/// The one thing that is read of a photograph's EXIF block: which way up it was taken.
#pragma once

#include <cstdint>
#include <span>

#include "semview/geometry/image.hpp"

namespace semview::io {

/// EXIF's numbers: where row 0 and column 0 of the stored picture are in the upright one.
enum class Orientation : std::uint8_t {
  kUpright = 1,
  kMirrored = 2,
  kUpsideDown = 3,
  kMirroredUpsideDown = 4,
  kTransposed = 5,
  kTurnedLeft = 6,  ///< stored turned to the left: shown after a quarter turn clockwise
  kAntiTransposed = 7,
  kTurnedRight = 8,
};

/// The orientation that an APP1 segment (after its length, from "Exif" on) states; `kUpright` where
/// it states none or is not sound: cameras write such blocks, and their pictures are good.
Orientation exif_orientation(std::span<const unsigned char> app1);

/// The upright picture.
RgbImage upright(RgbImage stored, Orientation orientation);

}  // namespace semview::io
