// SPDX-License-Identifier: Apache-2.0
/// JPEG files in. No input, however damaged, does more than return an error.
#pragma once

#include <cstdint>
#include <filesystem>

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"

namespace semview::io {

inline constexpr int kMaxJpegSide_px = 20'000;
inline constexpr std::int64_t kMaxJpegPixels = 100'000'000;

/// The colours of a JPEG file, upright: the EXIF orientation, if there is one, has been applied.
/// @errors kNotFound: cannot be opened; kDataLoss: not a JPEG file, damaged or cut short;
/// kOutOfRange: larger than `kMaxJpegSide_px` or `kMaxJpegPixels`; kInvalidArgument: CMYK colours.
Result<RgbImage> read_jpeg(const std::filesystem::path& path);

}  // namespace semview::io
