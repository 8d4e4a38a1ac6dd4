// SPDX-License-Identifier: Apache-2.0
/// The map bundle beside a semantic volume.
#pragma once

#include <filesystem>

#include "semview/core/result.hpp"
#include "semview/field/semantic_volume.hpp"
#include "semview/field/volume_mesh.hpp"

namespace semview::cli {

struct BundleFindings {
  map::TriangleMesh mesh;
  double ground_height_m = 0.0;
};

/// Whether the bundle of `volume_file` may be written into `folder`: there is none, or its own.
/// @errors kAlreadyExists: another map is there.
Status check_volume_bundle(const std::filesystem::path& folder,
                           const std::filesystem::path& volume_file);

/// Writes `mesh.glb` and `map.yaml`, which names it and the volume's file, into `folder`.
/// @errors kFailedPrecondition: no surface; kUnavailable: cannot be written.
Result<BundleFindings> write_volume_bundle(const std::filesystem::path& folder,
                                           const std::filesystem::path& volume_file,
                                           const field::SemanticVolume& volume,
                                           const field::VolumeMeshConfig& surface);

}  // namespace semview::cli
