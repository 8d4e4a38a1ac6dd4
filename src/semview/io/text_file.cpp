// SPDX-License-Identifier: Apache-2.0
#include "semview/io/text_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "semview/io/output_path.hpp"

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
  std::error_code error;
  const std::filesystem::file_status there = std::filesystem::status(path, error);
  // A pipe or a device is written to, not replaced.
  const bool replace = !std::filesystem::exists(there) || std::filesystem::is_regular_file(there);
  std::filesystem::path part = path;
  if (replace) part += ".part";
  std::FILE* const file = std::fopen(part.c_str(), "wb");
  if (file == nullptr) return cannot_write(path, errno);
  int failure = std::fwrite(text.data(), 1, text.size(), file) == text.size() ? 0 : errno;
  if (std::fclose(file) != 0 && failure == 0) failure = errno;
  if (!replace) return failure == 0 ? Status() : cannot_write(path, failure);
  if (failure == 0) std::filesystem::rename(part, path, error);
  if (failure == 0 && !error) return {};
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  return cannot_write(path, failure != 0 ? failure : error.value());
}

}  // namespace semview::io
