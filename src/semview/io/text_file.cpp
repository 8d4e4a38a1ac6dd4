// SPDX-License-Identifier: Apache-2.0
#include "semview/io/text_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

namespace semview::io {

Result<std::string> read_text_file(const std::filesystem::path& path, std::size_t max_bytes) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: is a folder, expected a file", path.string()));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
  }
  std::string text;
  std::string block(std::size_t{64} << 10U, '\0');
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block, 0, static_cast<std::size_t>(file.gcount()));
    if (text.size() > max_bytes) {
      return fail(ErrorCode::kOutOfRange,
                  fmt::format("{}: larger than {} bytes", path.string(), max_bytes));
    }
  }
  if (file.bad()) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
  }
  return text;
}

Status write_text_file(const std::filesystem::path& path, std::string_view text) {
  const auto cannot_write = [&](const std::string& why) {
    return fail(ErrorCode::kUnavailable,
                fmt::format("{}: cannot be written: {}", path.string(), why));
  };
  std::filesystem::path part = path;
  part += ".part";
  std::ofstream file(part, std::ios::binary | std::ios::trunc);
  if (!file) return cannot_write(std::strerror(errno));
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file) return cannot_write(std::strerror(errno));
  std::error_code error;
  std::filesystem::rename(part, path, error);
  if (error) return cannot_write(error.message());
  return {};
}

}  // namespace semview::io
