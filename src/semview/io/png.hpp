// SPDX-License-Identifier: Apache-2.0
/// PNG files in and out. No input, however damaged, does more than return an error.
#pragma once

#include <cstdint>
#include <filesystem>

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"

namespace semview::io {

inline constexpr int kMaxPngSide_px = 20'000;
inline constexpr std::int64_t kMaxPngPixels = 200'000'000;

struct PngSize {
  int rows = 0;
  int columns = 0;
};

/// The size that a PNG file's header states; the pixels are not looked at.
/// @errors kNotFound: cannot be opened; kDataLoss: not a PNG file or damaged; kOutOfRange: larger
/// than `kMaxPngSide_px` or `kMaxPngPixels`. The same hold for every reader below; each also
/// returns kInvalidArgument for a PNG of another kind than it reads.
Result<PngSize> png_size(const std::filesystem::path& path);

/// The samples of a grey PNG of up to 8 bits (fewer are spread to 0..255, as PNG defines), or the
/// palette indices of a palette PNG.
Result<Image<std::uint8_t>> read_png_grey(const std::filesystem::path& path);

/// The colours of any PNG whose pixels are opaque: RGB, RGBA, palette or grey; 16 bits are rounded
/// to 8.
/// @errors kInvalidArgument: a pixel is transparent; the message names the first one.
Result<RgbImage> read_png_rgb(const std::filesystem::path& path);

/// An sRGB colour with its opacity, 255 for an opaque one.
struct Rgba {
  unsigned char r = 0;
  unsigned char g = 0;
  unsigned char b = 0;
  unsigned char a = 255;

  bool operator==(const Rgba&) const = default;
};

struct RgbaPicture {
  Image<Rgba> pixels;
  bool has_alpha = false;  ///< the file has an alpha channel or a transparent colour
};

/// The colours of any PNG, 16 bits rounded to 8, and how opaque they are.
Result<RgbaPicture> read_png_rgba(const std::filesystem::path& path);

/// The samples of a 16-bit grey PNG.
Result<Image<std::uint16_t>> read_png_grey16(const std::filesystem::path& path);

/// Writes 8-bit grey, 8-bit RGB or 16-bit grey. Equal images make equal bytes.
/// @errors kInvalidArgument: an empty image; kUnavailable: the file cannot be written.
Status write_png(const std::filesystem::path& path, const Image<std::uint8_t>& image);
Status write_png(const std::filesystem::path& path, const RgbImage& image);
Status write_png(const std::filesystem::path& path, const Image<std::uint16_t>& image);

}  // namespace semview::io
