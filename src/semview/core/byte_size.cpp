// SPDX-License-Identifier: Apache-2.0
#include "semview/core/byte_size.hpp"

#include <charconv>
#include <limits>
#include <string>

#include <fmt/format.h>

namespace semview {

Result<std::uint64_t> parse_byte_size(std::string_view option, std::string_view text) {
  std::uint64_t bytes = 0;
  const char* const end = text.data() + text.size();
  auto [next, status] = std::from_chars(text.data(), end, bytes);
  unsigned shift = 0;
  if (status == std::errc() && next != end) {
    const std::string_view unit(next, static_cast<std::size_t>(end - next));
    const std::size_t power = std::string_view("KMGT").find(unit);
    if (unit.size() == 1 && power != std::string_view::npos) {
      shift = 10 * (static_cast<unsigned>(power) + 1);
      next = end;
    }
  }
  if (status != std::errc() || next != end ||
      bytes > (std::numeric_limits<std::uint64_t>::max() >> shift)) {
    return fail(
        Error{ErrorCode::kInvalidArgument,
              fmt::format("{} {}: expected a number of bytes, such as 500M or 20G", option, text),
              std::string(option)});
  }
  return bytes << shift;
}

}  // namespace semview
