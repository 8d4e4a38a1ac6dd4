// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cerrno>
#include <csetjmp>

#include <fmt/format.h>

#include "semview/io/output_path.hpp"
#include "semview/io/png.hpp"
#include "semview/io/png_library.hpp"

namespace semview::io {
namespace {

class Writer {
 public:
  explicit Writer(const std::filesystem::path& path)
      : path_(path), file_(std::fopen(path.c_str(), "wb")) {}
  ~Writer() { png_destroy_write_struct(&png_, &info_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  template <typename T>
  Status write(const Image<T>& image, int bit_depth, int colour_type);

 private:
  bool step_header(png_uint_32 rows, png_uint_32 columns, int bit_depth, int colour_type);
  bool step_row(png_const_bytep samples);
  bool step_end();
  /// The error of the last step, which was not libpng's own: its images are sound. What has been
  /// written is removed.
  tl::unexpected<Error> cannot_write(int error_number) {
    file_.reset();
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path_, ignored)) {
      std::filesystem::remove(path_, ignored);
    }
    return io::cannot_write(path_, error_number);
  }

  std::filesystem::path path_;
  detail::File file_;
  detail::PngMessage message_{};
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

bool Writer::step_header(png_uint_32 rows, png_uint_32 columns, int bit_depth, int colour_type) {
  if (setjmp(png_jmpbuf(png_)) != 0) return false;
  png_init_io(png_, file_.get());
  png_set_IHDR(png_,
               info_,
               columns,
               rows,
               bit_depth,
               colour_type,
               PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png_, info_);
  if constexpr (std::endian::native == std::endian::little) {
    if (bit_depth == 16) png_set_swap(png_);
  }
  return true;
}

bool Writer::step_row(png_const_bytep samples) {
  if (setjmp(png_jmpbuf(png_)) != 0) return false;
  png_write_row(png_, samples);
  return true;
}

bool Writer::step_end() {
  if (setjmp(png_jmpbuf(png_)) != 0) return false;
  png_write_end(png_, info_);
  return true;
}

template <typename T>
Status Writer::write(const Image<T>& image, int bit_depth, int colour_type) {
  if (image.empty() || image.rows() > kMaxPngSide_px || image.columns() > kMaxPngSide_px) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: an image of {} x {} pixels cannot be written",
                            path_.string(),
                            image.columns(),
                            image.rows()));
  }
  if (!file_) return io::cannot_write(path_, errno);
  png_ = png_create_write_struct(
      PNG_LIBPNG_VER_STRING, &message_, detail::on_png_error, detail::on_png_warning);
  info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
  if (info_ == nullptr) return fail(ErrorCode::kInternal, "libpng cannot be started");
  if (!step_header(static_cast<png_uint_32>(image.rows()),
                   static_cast<png_uint_32>(image.columns()),
                   bit_depth,
                   colour_type)) {
    return cannot_write(errno);
  }
  for (int row = 0; row < image.rows(); ++row) {
    if (!step_row(reinterpret_cast<png_const_bytep>(image.row(row).data()))) {
      return cannot_write(errno);
    }
  }
  if (!step_end()) return cannot_write(errno);
  if (std::fclose(file_.release()) != 0) return cannot_write(errno);
  return {};
}

}  // namespace

Status write_png(const std::filesystem::path& path, const Image<std::uint8_t>& image) {
  return Writer(path).write(image, 8, PNG_COLOR_TYPE_GRAY);
}

Status write_png(const std::filesystem::path& path, const RgbImage& image) {
  static_assert(sizeof(Rgb) == 3);
  return Writer(path).write(image, 8, PNG_COLOR_TYPE_RGB);
}

Status write_png(const std::filesystem::path& path, const Image<std::uint16_t>& image) {
  return Writer(path).write(image, 16, PNG_COLOR_TYPE_GRAY);
}

}  // namespace semview::io
