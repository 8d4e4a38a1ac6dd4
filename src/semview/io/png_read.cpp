// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <bit>
#include <cerrno>
#include <csetjmp>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "semview/io/png.hpp"
#include "semview/io/png_library.hpp"

namespace semview::io {
namespace {

std::string_view kind_name(int colour_type) {
  switch (colour_type) {
    case PNG_COLOR_TYPE_GRAY:
      return "grey";
    case PNG_COLOR_TYPE_GRAY_ALPHA:
      return "grey with alpha";
    case PNG_COLOR_TYPE_PALETTE:
      return "palette";
    case PNG_COLOR_TYPE_RGB:
      return "RGB";
    default:
      return "RGBA";
  }
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path)
      : path_(path), file_(std::fopen(path.c_str(), "rb")) {}
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  Status read_header();
  /// Calls `use(row, samples)` for each row from the top until it returns false.
  template <typename Use>
  Status read_rows(const Use& use);

  PngSize size() const { return {static_cast<int>(height_), static_cast<int>(width_)}; }
  int bit_depth() const { return bit_depth_; }
  int colour_type() const { return colour_type_; }
  tl::unexpected<Error> wrong_kind(std::string_view expected) const {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: is a {}-bit {} PNG, expected {}",
                            path_.string(),
                            bit_depth_,
                            kind_name(colour_type_),
                            expected));
  }
  std::string where(int row, int column) const {
    return fmt::format("{}: pixel at row {}, column {}", path_.string(), row, column);
  }

  // What the rows shall look like; called between the header and the rows.
  void spread_to_8_bits() { png_set_expand_gray_1_2_4_to_8(png_); }
  void unpack_indices() { png_set_packing(png_); }
  void native_16_bits() {
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
  }
  void to_rgba();
  bool has_alpha() const {
    return (colour_type_ & PNG_COLOR_MASK_ALPHA) != 0 ||
           png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
  }

 private:
  bool step_header();
  bool step_begin_rows();
  bool step_row(png_bytep samples);
  /// `where`: what was being read.
  tl::unexpected<Error> damaged(std::string_view where) const {
    const bool cut_short = std::feof(file_.get()) != 0;
    return fail(Error{
        ErrorCode::kDataLoss,
        cut_short
            ? fmt::format("{}: is cut short: the file ends in {}", path_.string(), where)
            : fmt::format("{}: is damaged in {} ({})", path_.string(), where, message_.data()),
        {},
        "save or copy the picture again, as a PNG"});
  }

  std::filesystem::path path_;
  detail::File file_;
  detail::PngMessage message_{};
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  png_uint_32 width_ = 0;
  png_uint_32 height_ = 0;
  int bit_depth_ = 0;
  int colour_type_ = 0;
  int passes_ = 1;
};

bool Reader::step_header() {
  if (setjmp(png_jmpbuf(png_)) != 0) return false;
  png_init_io(png_, file_.get());
  png_set_sig_bytes(png_, 8);
  png_read_info(png_, info_);
  png_get_IHDR(
      png_, info_, &width_, &height_, &bit_depth_, &colour_type_, nullptr, nullptr, nullptr);
  return true;
}

bool Reader::step_begin_rows() {
  if (setjmp(png_jmpbuf(png_)) != 0) return false;
  passes_ = png_set_interlace_handling(png_);
  png_read_update_info(png_, info_);
  return true;
}

bool Reader::step_row(png_bytep samples) {
  if (setjmp(png_jmpbuf(png_)) != 0) return false;
  png_read_row(png_, samples, nullptr);
  return true;
}

void Reader::to_rgba() {
  if (colour_type_ == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png_);
  if ((colour_type_ & PNG_COLOR_MASK_COLOR) == 0) {
    png_set_expand_gray_1_2_4_to_8(png_);
    png_set_gray_to_rgb(png_);
  }
  if (png_get_valid(png_, info_, PNG_INFO_tRNS) != 0) png_set_tRNS_to_alpha(png_);
  if (bit_depth_ == 16) png_set_scale_16(png_);
  png_set_add_alpha(png_, 0xff, PNG_FILLER_AFTER);
}

Status Reader::read_header() {
  if (!file_) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: cannot be opened: {}", path_.string(), std::strerror(errno)));
  }
  std::error_code ignored;
  if (std::filesystem::is_directory(path_, ignored)) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: is a folder, expected a PNG file", path_.string()));
  }
  std::array<png_byte, 8> signature{};
  if (std::fread(signature.data(), 1, signature.size(), file_.get()) != signature.size() ||
      png_sig_cmp(signature.data(), 0, signature.size()) != 0) {
    return fail(Error{ErrorCode::kDataLoss,
                      fmt::format("{}: is not a PNG file", path_.string()),
                      {},
                      "save the picture as a PNG; another ending of the name is not enough"});
  }
  png_ = png_create_read_struct(
      PNG_LIBPNG_VER_STRING, &message_, detail::on_png_error, detail::on_png_warning);
  info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
  if (info_ == nullptr) return fail(ErrorCode::kInternal, "libpng cannot be started");
  // Above our own limit, so that a large image is called large and not damaged.
  png_set_user_limits(png_, 1'000'000, 1'000'000);
  if (!step_header()) return damaged("its header");
  if (width_ > kMaxPngSide_px || height_ > kMaxPngSide_px ||
      std::int64_t{width_} * std::int64_t{height_} > kMaxPngPixels) {
    return fail(ErrorCode::kOutOfRange,
                fmt::format("{}: {} x {} pixels, at most {} a side and {} in all can be read",
                            path_.string(),
                            width_,
                            height_,
                            kMaxPngSide_px,
                            kMaxPngPixels));
  }
  return {};
}

template <typename Use>
Status Reader::read_rows(const Use& use) {
  if (!step_begin_rows()) return damaged("its header");
  const std::size_t row_bytes = png_get_rowbytes(png_, info_);
  // An interlaced file completes its rows only in the last pass: keep all of them.
  const std::size_t kept_rows = passes_ == 1 ? 1 : height_;
  std::vector<png_byte> samples(row_bytes * kept_rows);
  for (int pass = 0; pass < passes_; ++pass) {
    for (std::size_t row = 0; row < height_; ++row) {
      png_byte* const target = samples.data() + row_bytes * (row % kept_rows);
      if (!step_row(target)) return damaged("its pixels");
      if (pass + 1 == passes_ && !use(static_cast<int>(row), target)) return {};
    }
  }
  return {};
}

/// Reads rows whose samples are already of type T.
template <typename T>
Result<Image<T>> read_samples(Reader& reader) {
  Image<T> image(reader.size().rows, reader.size().columns);
  SEMVIEW_TRY_STATUS(reader.read_rows([&](int row, const png_byte* samples) {
    std::memcpy(image.row(row).data(), samples, image.row(row).size_bytes());
    return true;
  }));
  return image;
}

}  // namespace

Result<PngSize> png_size(const std::filesystem::path& path) {
  Reader reader(path);
  SEMVIEW_TRY_STATUS(reader.read_header());
  return reader.size();
}

Result<Image<std::uint8_t>> read_png_grey(const std::filesystem::path& path) {
  Reader reader(path);
  SEMVIEW_TRY_STATUS(reader.read_header());
  const bool palette = reader.colour_type() == PNG_COLOR_TYPE_PALETTE;
  if ((!palette && reader.colour_type() != PNG_COLOR_TYPE_GRAY) || reader.bit_depth() > 8) {
    return reader.wrong_kind("8-bit grey or palette");
  }
  if (palette) {
    reader.unpack_indices();
  } else {
    reader.spread_to_8_bits();
  }
  return read_samples<std::uint8_t>(reader);
}

Result<RgbImage> read_png_rgb(const std::filesystem::path& path) {
  Reader reader(path);
  SEMVIEW_TRY_STATUS(reader.read_header());
  reader.to_rgba();
  RgbImage image(reader.size().rows, reader.size().columns);
  std::string transparent;
  SEMVIEW_TRY_STATUS(reader.read_rows([&](int row, const png_byte* samples) {
    for (int column = 0; column < image.columns(); ++column, samples += 4) {
      if (samples[3] != 0xff) {
        transparent = fmt::format("{} is transparent (alpha {}), expected opaque colours",
                                  reader.where(row, column),
                                  samples[3]);
        return false;
      }
      image.at(row, column) = {samples[0], samples[1], samples[2]};
    }
    return true;
  }));
  if (!transparent.empty()) return fail(ErrorCode::kInvalidArgument, std::move(transparent));
  return image;
}

Result<RgbaPicture> read_png_rgba(const std::filesystem::path& path) {
  static_assert(sizeof(Rgba) == 4);
  Reader reader(path);
  SEMVIEW_TRY_STATUS(reader.read_header());
  RgbaPicture picture;
  picture.has_alpha = reader.has_alpha();
  reader.to_rgba();
  SEMVIEW_TRY(picture.pixels, read_samples<Rgba>(reader));
  return picture;
}

Result<Image<std::uint16_t>> read_png_grey16(const std::filesystem::path& path) {
  Reader reader(path);
  SEMVIEW_TRY_STATUS(reader.read_header());
  if (reader.colour_type() != PNG_COLOR_TYPE_GRAY || reader.bit_depth() != 16) {
    return reader.wrong_kind("16-bit grey");
  }
  reader.native_16_bits();
  return read_samples<std::uint16_t>(reader);
}

}  // namespace semview::io
