// SPDX-License-Identifier: Apache-2.0
/// The map bundle beside a semantic volume.
#pragma once

#include <cstddef>
#include <filesystem>

#include "semview/core/result.hpp"
#include "semview/field/semantic_volume.hpp"

namespace semview::cli {

struct BundleFindings {
  std::size_t triangles = 0;
  double ground_height_m = 0.0;
};

/// Writes `mesh.glb` and `map.yaml`, which names it and the volume's file, into `folder`.
/// @errors kFailedPrecondition: no surface; kUnavailable: cannot be written.
Result<BundleFindings> write_volume_bundle(const std::filesystem::path& folder,
                                           const std::filesystem::path& volume_file,
                                           const field::SemanticVolume& volume);

}  // namespace semview::cli
