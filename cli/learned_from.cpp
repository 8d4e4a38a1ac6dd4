// SPDX-License-Identifier: Apache-2.0
#include "learned_from.hpp"

#include <filesystem>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "semview/core/hash.hpp"
#include "semview/io/text_file.hpp"

namespace semview::cli {
namespace {

constexpr std::string_view kMark = "# learned from log ";
constexpr std::size_t kMaxTextBytes = std::size_t{64} << 20U;

/// The identity of a drive, wherever its folder is: its frames' stamps and how it went.
Result<std::string> log_id(const std::string& log) {
  Hasher hasher;
  for (const char* const name : {"frames.csv", "odometry.txt"}) {
    SEMVIEW_TRY(const std::string text,
                io::read_text_file(std::filesystem::path(log) / name, kMaxTextBytes));
    hasher.add_string(text);
  }
  return to_hex(hasher.digest());
}

}  // namespace

Result<std::string> learned_from_lines(const std::vector<std::string>& logs) {
  std::string lines;
  for (const std::string& log : logs) {
    SEMVIEW_TRY(const std::string id, log_id(log));
    std::string name = (std::filesystem::path(log) / "").parent_path().filename().string();
    for (char& c : name) {
      if (c == '\n' || c == '\r') c = ' ';
    }
    lines += fmt::format("{}{} {}\n", kMark, id, name);
  }
  return lines;
}

Status check_not_learned_from(const std::string& weights_file,
                              const std::vector<std::string>& logs) {
  SEMVIEW_TRY(const std::string text, io::read_text_file(weights_file, kMaxTextBytes));
  std::vector<std::string> ids;
  for (const std::string& log : logs) {
    SEMVIEW_TRY(ids.emplace_back(), log_id(log));
  }
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line) && line.starts_with('#');) {
    if (!line.starts_with(kMark)) continue;
    for (std::size_t i = 0; i < logs.size(); ++i) {
      if (!std::string_view(line).substr(kMark.size()).starts_with(ids[i])) continue;
      return fail(Error{ErrorCode::kFailedPrecondition,
                        fmt::format("{}: was learned from log {}, on which it proves nothing; "
                                    "expected logs that it has not seen",
                                    weights_file,
                                    logs[i]),
                        {},
                        "leave that log out, or learn from others"});
    }
  }
  return {};
}

}  // namespace semview::cli
