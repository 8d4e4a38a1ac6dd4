// SPDX-License-Identifier: Apache-2.0
/// What reading and writing PNG share of libpng. Inside the module only.
#pragma once

#include <array>
#include <cstdio>
#include <cstring>
#include <memory>

#include <png.h>

namespace semview::io::detail {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

using PngMessage = std::array<char, 160>;

// libpng leaves by longjmp, which must not skip a destructor: every call that may fail sits alone
// in a member function that holds nothing but plain values.
inline void on_png_error(png_structp png, png_const_charp text) {
  auto* message = static_cast<PngMessage*>(png_get_error_ptr(png));
  std::strncpy(message->data(), text, message->size() - 1);
  png_longjmp(png, 1);
}
inline void on_png_warning(png_structp, png_const_charp) {}

}  // namespace semview::io::detail
