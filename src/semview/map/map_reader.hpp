// SPDX-License-Identifier: Apache-2.0
/// The one way from files to a `SemanticMap`, for loading and checking. Inside the module only.
#pragma once

#include <filesystem>
#include <optional>

#include "semview/map/map_problem.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::map::detail {

/// Reads the map at `path` and adds everything wrong with its files to `report`. None exactly if
/// the report has an error then.
std::optional<SemanticMap> read_map(const std::filesystem::path& path,
                                    const LoadOptions& options,
                                    MapReport& report);

}  // namespace semview::map::detail
