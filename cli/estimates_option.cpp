// SPDX-License-Identifier: Apache-2.0
#include "estimates_option.hpp"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace semview::cli {

CLI::Option* add_estimates_option(CLI::App& verb,
                                  std::vector<std::string>& estimates,
                                  const std::string& description) {
  return verb.add_option("--estimates", estimates, description)
      ->type_name("NAME=DIR")
      ->allow_extra_args(false);
}

Result<std::vector<NamedFolder>> parse_estimates(const std::vector<std::string>& estimates) {
  const auto refuse = [](std::string message) {
    return fail(Error{ErrorCode::kInvalidArgument, std::move(message), "--estimates"});
  };
  std::vector<NamedFolder> folders;
  for (const std::string& text : estimates) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == text.size()) {
      return refuse(fmt::format("--estimates {}: expected NAME=DIR", text));
    }
    folders.push_back({text.substr(0, equals), text.substr(equals + 1)});
    const auto same = [&](const NamedFolder& one) { return one.name == folders.back().name; };
    if (std::ranges::count_if(folders, same) > 1) {
      return refuse(fmt::format("--estimates {}: there are two of that name", text));
    }
  }
  return folders;
}

}  // namespace semview::cli
