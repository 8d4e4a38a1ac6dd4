// SPDX-License-Identifier: Apache-2.0
/// Reduces a depth image with labels to the voxels of the robot's frame that it saw.
#pragma once

#include "semview/core/result.hpp"
#include "semview/view/depth_observation.hpp"
#include "semview/view/voxel_list.hpp"

namespace semview::observation {

struct VoxelReductionConfig {
  double voxel_m = 0.05;     ///< in [0.01, 1]
  double min_depth_m = 0.1;  ///< nearer is left out
  double max_depth_m = 5.0;  ///< farther is left out, in (min, 100]: noise grows with z²
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const VoxelReductionConfig& config);

/// Counts the back-projected pixels by class and voxel. Pixels without a depth between the limits
/// are left out; label 0 and ids past the classes count as `kUnknown`.
/// @errors kInvalidArgument: sizes that do not match, a camera or mounting that is not finite or
/// farther than 100 m from the base, no usable depth.
/// @cost O(pixels); some 50 pixels come to a voxel of 5 cm.
/// @source Gomez et al. 2023, equation (1)
Result<VoxelList> reduce(const DepthObservation& observation,
                         const VoxelReductionConfig& config = {});

}  // namespace semview::observation
