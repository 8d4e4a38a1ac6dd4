// SPDX-License-Identifier: Apache-2.0
/// What depth cameras saw as messages.
#pragma once

#include "semview/core/result.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/v1/scores.pb.h"
#include "semview/view/depth_observation.hpp"
#include "semview/view/voxel_list.hpp"

namespace semview::protocol {

/// Pixels that a list of voxels may stand for: those of the largest image.
inline constexpr std::uint32_t kMaxVoxelPixels = 4096 * 4096;

/// The voxels; classes and stamp are the whole observation's and travel with it.
void to_wire(const VoxelList& list, v1::VoxelList* wire);
/// @errors kInvalidArgument: lists of unequal length or none, an id that is not of `classes`,
/// voxels out of order or there twice, a number out of range; the field is named.
Result<VoxelList> from_wire(const v1::VoxelList& wire, const ClassTable& classes, double stamp_s);

/// As above. Depths are rounded to whole millimetres; what 16 bits cannot hold was not measured.
void to_wire(const DepthObservation& seen, v1::DepthImage* wire);
/// @errors kInvalidArgument: images that do not match, intrinsics out of range, or a mounting that
/// is no rotation and translation; the field is named.
Result<DepthObservation> from_wire(const v1::DepthImage& wire,
                                   const ClassTable& classes,
                                   double stamp_s);

}  // namespace semview::protocol
