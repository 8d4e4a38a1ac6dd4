// SPDX-License-Identifier: Apache-2.0
#include "semview/io/npy.hpp"

#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "semview/io/text_file.hpp"

namespace semview::io {
namespace {

template <typename T>
Status write(const std::filesystem::path& path, const Image<T>& image, std::string_view type) {
  static_assert(sizeof(T) == 4);
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}), }}",
                                   type,
                                   image.rows(),
                                   image.columns());
  // Magic, version and length take 10 bytes; the whole is a multiple of 64 and ends the line.
  header.append(63 - (10 + header.size()) % 64, ' ').push_back('\n');
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes.push_back(static_cast<char>(header.size() & 0xff));
  bytes.push_back(static_cast<char>(header.size() >> 8U));
  bytes += header;
  for (const T& value : image.pixels()) {
    const auto word = std::bit_cast<std::uint32_t>(value);
    for (unsigned shift = 0; shift < 32; shift += 8) {
      bytes.push_back(static_cast<char>((word >> shift) & 0xff));
    }
  }
  return write_text_file(path, bytes);
}

}  // namespace

Status write_npy(const std::filesystem::path& path, const Image<float>& image) {
  return write(path, image, "<f4");
}

Status write_npy(const std::filesystem::path& path, const Image<std::int32_t>& image) {
  return write(path, image, "<i4");
}

}  // namespace semview::io
