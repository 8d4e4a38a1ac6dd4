// SPDX-License-Identifier: Apache-2.0
#include "starts_option.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace semview::cli {

void add_starts_option(CLI::App& verb,
                       std::vector<std::string>& starts,
                       const std::string& unless_given) {
  verb.add_option(
          "--starts", starts, "Known start, unknown start or both; default: " + unless_given)
      ->type_name("local,global")
      ->delimiter(',')
      ->allow_extra_args(false);
}

Result<std::vector<paper2017::Start>> parse_starts(const std::vector<std::string>& starts) {
  std::vector<paper2017::Start> parsed;
  for (const std::string& start : starts) {
    if (start != "local" && start != "global") {
      return fail(Error{ErrorCode::kInvalidArgument,
                        fmt::format("--starts {}: expected local or global", start),
                        "--starts"});
    }
    parsed.push_back(start == "local" ? paper2017::Start::kLocal : paper2017::Start::kGlobal);
  }
  return parsed;
}

}  // namespace semview::cli
