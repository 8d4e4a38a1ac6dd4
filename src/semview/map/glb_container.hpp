// SPDX-License-Identifier: Apache-2.0
/// The outer shell of a binary glTF file: a header, a JSON chunk and a binary chunk.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "semview/core/result.hpp"

namespace semview::map {

/// Views into the bytes that were split.
struct GlbChunks {
  std::string_view json;
  std::string_view binary;  ///< empty if the file has no such chunk; may end in up to 3 pad bytes
};

/// Finds the chunks of a glTF 2.0 file; `name` stands in messages. Unknown further chunks are
/// passed over, as glTF demands.
/// @errors kDataLoss: not a GLB file, or a length that does not fit; kUnimplemented: another
/// version of the container.
Result<GlbChunks> split_glb(std::string_view bytes, std::string_view name);

/// The inverse: pads both chunks to whole words. @errors kInvalidArgument: 4 GiB or more.
Result<std::string> join_glb(std::string_view json, std::string_view binary);

}  // namespace semview::map
