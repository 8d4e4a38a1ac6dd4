// SPDX-License-Identifier: Apache-2.0
/// What of a glTF file is handed to the library that parses it. Inside the module only.
#pragma once

#include <string>
#include <string_view>

#include "semview/core/result.hpp"
#include "semview/map/glb_container.hpp"

namespace semview::map::detail {

/// The file with nothing in it but what makes triangles and their names: what is not read cannot
/// do harm. (tinygltf recurses into extras and looks into images before it has checked their
/// place.)
/// @errors kDataLoss, kUnimplemented, kResourceExhausted: with `name` in front.
Result<std::string> geometry_only(const GlbChunks& chunks, std::string_view name);

}  // namespace semview::map::detail
