// SPDX-License-Identifier: Apache-2.0
/// The check of a fused map against frames that were left out of it.
#pragma once

#include <cstddef>
#include <span>

#include "fuse_frames.hpp"
#include "semview/core/result.hpp"
#include "semview/evaluation/depth_residuals.hpp"
#include "semview/map/triangle_mesh.hpp"

namespace semview::cli {

struct LeftOutFindings {
  std::size_t frames = 0;  ///< that could be read
  evaluation::DepthResiduals residuals;
};

/// Casts the mesh from each frame's pose and compares depths.
/// @errors those of Scene::build
Result<LeftOutFindings> check_left_out(const FuseFrames& frames,
                                       std::span<const std::size_t> left_out,
                                       const map::TriangleMesh& mesh,
                                       double max_depth_m);

}  // namespace semview::cli
