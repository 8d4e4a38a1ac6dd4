// SPDX-License-Identifier: Apache-2.0
/// The mesh half of `read_map`. Inside the module only.
#pragma once

#include <filesystem>
#include <optional>

#include "semview/map/map_file.hpp"
#include "semview/map/map_problem.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::map::detail {

/// The mesh that `file` names, labelled with the ids of its classes; none and errors in `report`.
std::optional<MeshGeometry> read_mesh(const MapFile& file, MapReport& report);

/// A `.glb` without a map.yaml: names sorted, ground 0, the id from the file's name.
std::optional<SemanticMap> read_bare_glb(const std::filesystem::path& path, MapReport& report);

}  // namespace semview::map::detail
