// SPDX-License-Identifier: Apache-2.0
/// The surface of a semantic volume as labelled triangles.
#pragma once

#include "semview/core/thread_pool.hpp"
#include "semview/field/semantic_volume.hpp"
#include "semview/map/triangle_mesh.hpp"

namespace semview::field {

struct VolumeMeshConfig {
  float min_weight = 2.0F;  ///< frames that must have seen a voxel, at least 1
};

/// Triangles where the distance passes 0 between voxels that all were observed, counter-clockwise
/// seen from free space. A triangle's class is the one counted most often in the 27 voxels round
/// its centre; where nothing was counted the id after the volume's last class.
/// @errors kFailedPrecondition: no surface.
Result<map::TriangleMesh> mesh_of(const SemanticVolume& volume,
                                  const VolumeMeshConfig& config,
                                  ThreadPool& pool);

}  // namespace semview::field
