// SPDX-License-Identifier: Apache-2.0
#include "semview/io/photo.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "semview/io/jpeg.hpp"
#include "semview/io/png.hpp"

namespace semview::io {

Result<RgbImage> read_photo(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: is a folder, expected a PNG or JPEG file", path.string()));
  }
  std::array<unsigned char, 2> first{};
  {
    std::ifstream file(path, std::ios::binary);
    if (!file) {
      return fail(ErrorCode::kNotFound,
                  fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
    }
    file.read(reinterpret_cast<char*>(first.data()), first.size());
  }
  if (first[0] == 0x89 && first[1] == 'P') return read_png_rgb(path);
  if (first[0] == 0xff && first[1] == 0xd8) return read_jpeg(path);
  return fail(Error{ErrorCode::kDataLoss,
                    fmt::format("{}: is neither a PNG nor a JPEG file", path.string()),
                    {},
                    "save the picture as one of them; another ending of the name is not enough"});
}

}  // namespace semview::io
