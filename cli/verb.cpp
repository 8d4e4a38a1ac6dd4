// SPDX-License-Identifier: Apache-2.0
#include "verb.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "semview/geometry/angle.hpp"

namespace semview::cli {

int report(const Status& status) {
  if (status) return 0;
  const Error& error = status.error();
  fmt::print(stderr, "semview: {}\n", error.message);
  if (!error.hint.empty()) fmt::print(stderr, "  {}\n", error.hint);
  const bool usage = error.code == ErrorCode::kInvalidArgument && error.field.starts_with("--");
  return usage ? kExitUsage : kExitFailed;
}

void check_whole_numbers(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (!option->get_type_name().starts_with("UINT")) continue;  // CLI11's word for unsigned
    option->check([](const std::string& text) {
      std::uint64_t number = 0;
      const char* const end = text.data() + text.size();
      const auto [stop, status] = std::from_chars(text.data(), end, number);
      return status == std::errc() && stop == end
                 ? std::string()
                 : fmt::format("{} is not a whole number from 0 to {}",
                               text,
                               std::numeric_limits<std::uint64_t>::max());
    });
  }
  for (CLI::App* verb : app.get_subcommands({})) check_whole_numbers(*verb);
}

double shown_deg(double angle_rad) { return std::round(deg_from_rad(angle_rad) * 1e9) / 1e9; }

Result<std::vector<double>> parse_numbers(std::string_view option,
                                          const std::string& text,
                                          std::size_t count) {
  std::vector<double> numbers;
  const char* next = text.data();
  const char* const end = text.data() + text.size();
  bool complete = false;
  while (!complete) {
    double number = 0.0;
    const auto [stop, status] = std::from_chars(next, end, number);
    if (status != std::errc() || !std::isfinite(number) || (stop != end && *stop != ',')) break;
    numbers.push_back(number);
    complete = stop == end;
    next = complete ? end : stop + 1;
  }
  if (!complete || numbers.size() != count) {
    return fail(Error{
        ErrorCode::kInvalidArgument,
        fmt::format("{} {}: expected {} finite numbers, comma-separated", option, text, count),
        std::string(option)});
  }
  return numbers;
}

}  // namespace semview::cli
