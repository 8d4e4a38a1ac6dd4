// SPDX-License-Identifier: Apache-2.0
/// Numbers of bytes as people write them.
#pragma once

#include <cstdint>
#include <string_view>

#include "semview/core/result.hpp"

namespace semview {

/// A whole number of bytes, or one with K, M, G or T (powers of 1024) behind it: `500M`.
/// @errors kInvalidArgument, with `option`, which the message names, as the field.
Result<std::uint64_t> parse_byte_size(std::string_view option, std::string_view text);

}  // namespace semview
