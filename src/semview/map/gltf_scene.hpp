// SPDX-License-Identifier: Apache-2.0
/// A parsed glTF scene as one labelled mesh. Inside the module only.
#pragma once

#include <string_view>

#include "semview/core/result.hpp"
#include "semview/map/gltf_library.hpp"
#include "semview/map/gltf_read.hpp"

namespace semview::map::detail {

/// Every triangle of the default scene in frame `map` (z up), with the class of its material, mesh
/// or node. @errors as `parse_glb`, with `name` in front.
Result<LabelledMesh> read_scene(const tinygltf::Model& model, std::string_view name);

}  // namespace semview::map::detail
