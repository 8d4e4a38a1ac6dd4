// SPDX-License-Identifier: Apache-2.0
#include "semview/io/range_png.hpp"

#include <algorithm>
#include <cmath>

namespace semview::io {

Image<std::uint16_t> millimetres(const RangeImage& ranges_m) {
  Image<std::uint16_t> result(ranges_m.rows(), ranges_m.columns());
  for (std::size_t i = 0; i < ranges_m.pixels().size(); ++i) {
    const float range_m = ranges_m.pixels()[i];
    if (!std::isfinite(range_m)) continue;
    const double millimetres = std::round(static_cast<double>(range_m) * 1000.0);
    result.pixels()[i] = static_cast<std::uint16_t>(std::clamp(millimetres, 1.0, 65535.0));
  }
  return result;
}

Image<float> depth_m(const Image<std::uint16_t>& millimetres) {
  Image<float> depths(millimetres.rows(), millimetres.columns());
  for (std::size_t i = 0; i < depths.pixels().size(); ++i) {
    depths.pixels()[i] = static_cast<float>(millimetres.pixels()[i]) / 1000.0F;
  }
  return depths;
}

}  // namespace semview::io
