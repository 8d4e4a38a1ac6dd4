// SPDX-License-Identifier: Apache-2.0
/// `--estimates NAME=DIR`: another program's trajectories.
#pragma once

#include <string>
#include <vector>

#include "semview/core/result.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace semview::cli {

struct NamedFolder {
  std::string name;
  std::string directory;
};

CLI::Option* add_estimates_option(CLI::App& verb,
                                  std::vector<std::string>& estimates,
                                  const std::string& description);

/// @errors kInvalidArgument, with the option as the field: a value without name or folder, or two
/// of one name.
Result<std::vector<NamedFolder>> parse_estimates(const std::vector<std::string>& estimates);

}  // namespace semview::cli
