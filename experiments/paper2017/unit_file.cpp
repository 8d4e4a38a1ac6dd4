// SPDX-License-Identifier: Apache-2.0
#include "unit_file.hpp"

#include <fmt/format.h>

#include "semview/io/text_file.hpp"

namespace semview::paper2017 {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{256} << 20U;
constexpr std::string_view kLastLine = "# end\n";

tl::unexpected<Error> refuse(std::string message, std::string hint) {
  return fail(
      Error{ErrorCode::kFailedPrecondition, std::move(message), "--resume", std::move(hint)});
}

}  // namespace

std::string unit_text(std::string_view csv, std::string_view first_line) {
  return std::string(first_line).append(csv).append(kLastLine);
}

Result<std::string> read_unit(const std::filesystem::path& file,
                              std::string_view first_line,
                              std::string_view header,
                              const UnitCheck& check) {
  SEMVIEW_TRY(std::string text, io::read_text_file(file, kMaxBytes));
  const std::string head = std::string(first_line).append(header);
  if (!text.starts_with(first_line)) {
    return refuse(fmt::format("{}: was made with other settings or methods than those asked for",
                              file.string()),
                  "choose another --out, or the options of settings.txt there");
  }
  const std::string again = fmt::format("delete {} and resume again", file.string());
  if (!text.starts_with(head) || !text.ends_with(kLastLine)) {
    return refuse(fmt::format("{}: was cut, its last line is not '# end'", file.string()), again);
  }
  if (const Status readable = check(text, file.string()); !readable) {
    return refuse(readable.error().message, again);
  }
  return text.substr(head.size(), text.size() - head.size() - kLastLine.size());
}

}  // namespace semview::paper2017
