// SPDX-License-Identifier: Apache-2.0
/// PGM images, as ROS map_server maps carry them.
#pragma once

#include <cstdint>
#include <filesystem>

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"

namespace semview::io {

/// Reads a PGM of up to 8 bits, binary (P5) or text (P2). Samples of a file whose largest value is
/// not 255 are scaled to 0..255, rounded to nearest.
/// @errors kNotFound: cannot be read; kInvalidArgument: not such a PGM; kDataLoss: cut short or a
/// sample above the largest value; kOutOfRange: above the limits of io/png.hpp.
Result<Image<std::uint8_t>> read_pgm(const std::filesystem::path& path);

}  // namespace semview::io
