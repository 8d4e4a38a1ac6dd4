// SPDX-License-Identifier: Apache-2.0
#include "fusion_peer.hpp"

namespace semview::bench {

std::unique_ptr<FusionPeer> open3d_fusion(const field::VolumeShape& /*shape*/,
                                          const field::FusionConfig& /*config*/) {
  return nullptr;
}

}  // namespace semview::bench
