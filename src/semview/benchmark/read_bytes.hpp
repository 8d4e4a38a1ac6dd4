// SPDX-License-Identifier: Apache-2.0
/// How fast memory that a core has in its cache can be read at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace semview::benchmark {

/// Reads `bytes` bytes from `memory`, in order and from its beginning again when it ends, with the
/// widest vectors of this machine. `memory` is aligned to 64 bytes and a multiple of 256.
/// @return what came of them, so that they must be read
std::uint64_t read_bytes(std::span<const std::uint64_t> memory, std::size_t bytes);

}  // namespace semview::benchmark
