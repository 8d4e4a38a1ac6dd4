// SPDX-License-Identifier: Apache-2.0
/// What the programs here say of themselves.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <span>
#include <string_view>

#include <fmt/format.h>

namespace semview::bench {

/// Prints `usage` where --help or an option that is none of `options` was given; the exit code
/// then.
inline std::optional<int> explain(int argc,
                                  char** argv,
                                  std::string_view usage,
                                  std::initializer_list<std::string_view> options = {}) {
  for (const std::string_view argument : std::span(argv + 1, argv + argc)) {
    if (argument == "--help" || argument == "-h") {
      fmt::print("{}\n", usage);
      return 0;
    }
    if (argument.starts_with('-') && std::ranges::find(options, argument) == options.end()) {
      fmt::print(stderr, "{}: there is no such option\n{}\n", argument, usage);
      return 2;
    }
  }
  return std::nullopt;
}

}  // namespace semview::bench
