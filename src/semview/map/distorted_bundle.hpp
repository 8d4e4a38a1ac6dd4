// SPDX-License-Identifier: Apache-2.0
/// Map folders that are scaled and sheared copies of others.
#pragma once

#include <filesystem>

#include "semview/core/result.hpp"
#include "semview/geometry/affine.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::map {

/// Makes `directory` with the drawn map at `path` as `distort` has it: plan, origin and occupancy
/// image are new, classes, heights and names as they were, and the files beside them (weights,
/// licences) are copied. What is written loads with the fingerprint of `distort`'s map.
/// @errors those of `load_map` and `distort`; kAlreadyExists: there is a map.yaml already;
/// kUnavailable: cannot be written.
Status write_distorted(const std::filesystem::path& path,
                       const MapAffine& affine,
                       const std::filesystem::path& directory,
                       const LoadOptions& options = {});

}  // namespace semview::map
