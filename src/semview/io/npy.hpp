// SPDX-License-Identifier: Apache-2.0
/// NumPy's `.npy` files, format version 1.0.
#pragma once

#include <cstdint>
#include <filesystem>

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"

namespace semview::io {

/// Writes an array of shape (rows, columns), little-endian, in C order; `numpy.load` reads it.
/// @errors kUnavailable: the file cannot be written.
Status write_npy(const std::filesystem::path& path, const Image<float>& image);
Status write_npy(const std::filesystem::path& path, const Image<std::int32_t>& image);

}  // namespace semview::io
