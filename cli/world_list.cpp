// SPDX-License-Identifier: Apache-2.0
#include "world_list.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace semview::cli {
namespace {

constexpr std::size_t kMostWorlds = 100;

std::optional<std::uint64_t> seed(std::string_view digits) {
  std::uint64_t value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, status] = std::from_chars(digits.data(), end, value);
  if (status != std::errc() || stop != end) return std::nullopt;
  return value;
}

/// Appends `3` or `1..6`; false: it is neither, or there are too many.
bool append(std::string_view part, std::vector<std::uint64_t>& worlds) {
  const std::size_t dots = part.find("..");
  const std::optional<std::uint64_t> first = seed(part.substr(0, dots));
  const std::optional<std::uint64_t> last =
      dots == std::string_view::npos ? first : seed(part.substr(dots + 2));
  if (!first || !last || *last < *first || *last - *first >= kMostWorlds) return false;
  for (std::uint64_t i = 0; i <= *last - *first; ++i) {
    if (std::ranges::find(worlds, *first + i) != worlds.end()) return false;
    worlds.push_back(*first + i);
  }
  return worlds.size() <= kMostWorlds;
}

}  // namespace

Result<std::vector<std::uint64_t>> parse_worlds(const std::string& text) {
  std::vector<std::uint64_t> worlds;
  for (std::string_view rest = text;;) {
    const std::size_t comma = rest.find(',');
    if (!append(rest.substr(0, comma), worlds)) break;
    if (comma == std::string_view::npos) return worlds;
    rest.remove_prefix(comma + 1);
  }
  return fail(Error{ErrorCode::kInvalidArgument,
                    fmt::format("--worlds {}: expected seeds or ranges such as 1,2,3 or 1..6, each "
                                "world once, of at most {} worlds",
                                text,
                                kMostWorlds),
                    "--worlds"});
}

std::string world_list(const std::vector<std::uint64_t>& worlds) {
  std::string text;
  for (std::size_t i = 0; i < worlds.size();) {
    std::size_t end = i + 1;
    while (end < worlds.size() && worlds[end] == worlds[end - 1] + 1) ++end;
    if (i > 0) text += ',';
    text += fmt::format("{}", worlds[i]);
    if (end > i + 1) text += fmt::format("..{}", worlds[end - 1]);
    i = end;
  }
  return text;
}

}  // namespace semview::cli
