// SPDX-License-Identifier: Apache-2.0
/// From the colours of a drawing to profile indices. Inside the module only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "semview/geometry/image.hpp"
#include "semview/map/map_problem.hpp"

namespace semview::map::detail {

/// A colour and what it stands for in messages.
struct PaletteEntry {
  Rgb color;
  std::string name;
};

/// Matches every pixel with `palette`, whose entry i becomes index i. Colours that are not in it
/// are errors, one a colour (the most frequent ones by themselves, the rest together), each with
/// count, first pixel and the nearest entry; with `nearest_colour` they become the nearest entry
/// among those of pixels close by whose colour is beyond doubt (else the nearest of all: so the
/// smoothed edge between two classes never looks like a third), and one warning counts them.
std::optional<Image<std::uint8_t>> match_colors(const RgbImage& labels,
                                                const std::vector<PaletteEntry>& palette,
                                                bool nearest_colour,
                                                const std::filesystem::path& file,
                                                MapReport& report);

}  // namespace semview::map::detail
