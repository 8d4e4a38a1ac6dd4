// SPDX-License-Identifier: Apache-2.0
/// Masks of single objects, as detectors make them, flattened to one label image. See
/// docs/formats/volume.md.
#pragma once

#include <filesystem>

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/view/column_view.hpp"

namespace semview::io {

/// Reads a list `mask,class,score` of 8-bit masks (not 0: the object is there), named relative to
/// the list's folder, and gives each pixel the class of the mask with the highest score that covers
/// it, the first of equals; `kNoHit` where none does. An empty image if the list has no line.
/// @errors kNotFound: the list or a mask is missing; kInvalidArgument with file and line: a damaged
/// line, a class that `classes` does not have, a score outside [0, 1], masks of different sizes.
Result<LabelImage> read_instance_masks(const std::filesystem::path& list,
                                       const ClassTable& classes);

}  // namespace semview::io
