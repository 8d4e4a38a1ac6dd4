// SPDX-License-Identifier: Apache-2.0
/// Another program that fuses depth images.
#pragma once

#include <memory>

#include "semview/field/fusion.hpp"
#include "semview/map/triangle_mesh.hpp"

namespace semview::bench {

class FusionPeer {
 public:
  virtual ~FusionPeer() = default;
  virtual void add(const field::DepthFrame& frame) = 0;
  /// Without classes.
  virtual map::TriangleMesh mesh() const = 0;
};

/// Open3D's ScalableTSDFVolume; null where Open3D was not there at build time.
std::unique_ptr<FusionPeer> open3d_fusion(const field::VolumeShape& shape,
                                          const field::FusionConfig& config);

}  // namespace semview::bench
