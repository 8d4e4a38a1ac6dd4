// SPDX-License-Identifier: Apache-2.0
/// Camera images, whatever kind of file they are in.
#pragma once

#include <filesystem>

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"

namespace semview::io {

/// The colours of a PNG or JPEG file; its first bytes say which it is, not its name.
/// @errors kNotFound: cannot be opened; kDataLoss: neither of the two, or damaged; those of
/// `read_png_rgb` and `read_jpeg`.
Result<RgbImage> read_photo(const std::filesystem::path& path);

}  // namespace semview::io
