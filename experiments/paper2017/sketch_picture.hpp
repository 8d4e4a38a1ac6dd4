// SPDX-License-Identifier: Apache-2.0
/// A drive on a sketch, to look at.
#pragma once

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"
#include "sketch_drives.hpp"

namespace semview::paper2017 {

/// Left the building as it is, with the robot's way; right the sketch, with that way as it is there
/// in black, and of each stop where it was thought to be: a blue disc in the right room, an orange
/// one in a wrong one, tied to its true place by a line.
/// @param settings  of the drive; the plans are drawn in `pictures/` of `out`
/// @errors those of drawing and loading maps.
Result<RgbImage> draw_sketch_drive(const SketchSettings& settings, const SketchDrive& drive);

}  // namespace semview::paper2017
