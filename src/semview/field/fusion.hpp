// SPDX-License-Identifier: Apache-2.0
/// Posed depth and label images into a semantic volume.
#pragma once

#include <cstddef>

#include <Eigen/Geometry>

#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/field/semantic_volume.hpp"
#include "semview/geometry/image.hpp"
#include "semview/geometry/pinhole_camera.hpp"
#include "semview/view/column_view.hpp"

namespace semview::field {

/// One RGB-D image. All images have the camera's size; labels and colour may be empty.
struct DepthFrame {
  Image<float> depth_m;  ///< z in the optical frame; 0 or not finite: not measured
  LabelImage labels;     ///< ids of the volume's classes; 0 and `kUnknown` are not counted
  RgbImage colour;
  PinholeCamera camera;
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();  ///< optical frame
};

struct FusionConfig {
  double min_depth_m = 0.1;
  double max_depth_m = 5.0;  ///< farther is not fused: the noise of depth cameras grows with z²
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const FusionConfig& config);

struct FusedFrame {
  std::size_t depth_pixels = 0;  ///< of a depth that was used
  std::size_t blocks = 0;        ///< of the volume that saw this frame
};

/// Fuses one frame: every voxel before the surface and up to the truncation distance behind it
/// takes the measured distance along the optical axis into its weighted mean, each frame with
/// weight 1; voxels within one voxel of the surface count the pixel's class.
///
/// The same volume for any number of threads.
/// @errors kInvalidArgument: sizes that do not match, a pose that is not finite, no usable depth;
/// kResourceExhausted: more than `kMaxBlocks`.
/// @source Gomez et al. 2023, section 3.1, on Zeng et al.'s tsdf-fusion
Result<FusedFrame> fuse(const DepthFrame& frame,
                        const FusionConfig& config,
                        ThreadPool& pool,
                        SemanticVolume& volume);

}  // namespace semview::field
