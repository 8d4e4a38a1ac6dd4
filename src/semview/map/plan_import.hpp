// SPDX-License-Identifier: Apache-2.0
/// Makes a map bundle from a colour-coded plan with a list of heights.
#pragma once

#include <filesystem>

#include "semview/core/result.hpp"

namespace semview::map {

/// Reads a `plan_*.yaml` (see docs/formats/map_bundle.md#importing-plans) and writes a bundle into
/// `directory`, which is made; its id is the folder's name.
/// @errors kNotFound, kInvalidArgument: the plan; kAlreadyExists: `directory` holds a map already.
Status import_plan(const std::filesystem::path& plan_yaml, const std::filesystem::path& directory);

}  // namespace semview::map
