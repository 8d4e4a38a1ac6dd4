// SPDX-License-Identifier: Apache-2.0
/// `--starts local,global`.
#pragma once

#include <string>
#include <vector>

#include "experiments/paper2017/methods.hpp"
#include "semview/core/result.hpp"

namespace CLI {
class App;
}

namespace semview::cli {

/// @param unless_given  which they are if nobody says, for the help
void add_starts_option(CLI::App& verb,
                       std::vector<std::string>& starts,
                       const std::string& unless_given);

/// @errors kInvalidArgument, with the option as the field.
Result<std::vector<paper2017::Start>> parse_starts(const std::vector<std::string>& starts);

}  // namespace semview::cli
