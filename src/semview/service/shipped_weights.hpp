// SPDX-License-Identifier: Apache-2.0
/// The weight matrix that a map brings along.
#pragma once

#include <filesystem>
#include <string>

#include "semview/core/result.hpp"

namespace semview::service {

/// The text of `weights.csv` in a map's folder; empty if there is none.
/// @errors kNotFound: it cannot be read; kOutOfRange: it is too large to be one.
Result<std::string> shipped_weights_csv(const std::filesystem::path& map_directory);

}  // namespace semview::service
