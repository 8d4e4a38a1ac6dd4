// SPDX-License-Identifier: Apache-2.0
/// Which generated worlds an experiment uses: --worlds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "semview/core/result.hpp"

namespace semview::cli {

/// Seeds and ranges of them, comma-separated: `1..6`, `1,2,3`, `1..3,7`; at most 100 worlds.
/// @errors kInvalidArgument, field `--worlds`: not such a list, or a world twice.
Result<std::vector<std::uint64_t>> parse_worlds(const std::string& text);

/// The shortest list that `parse_worlds` reads as these, in their order.
std::string world_list(const std::vector<std::uint64_t>& worlds);

}  // namespace semview::cli
