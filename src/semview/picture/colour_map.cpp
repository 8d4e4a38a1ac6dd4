// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace semview::picture {
namespace {

// Every tenth of matplotlib's table; straight lines between are within 3/255 of it.
constexpr std::array<Rgb, 11> kViridis{{{68, 1, 84},
                                        {72, 36, 117},
                                        {65, 68, 135},
                                        {53, 95, 141},
                                        {42, 120, 142},
                                        {33, 145, 140},
                                        {34, 168, 132},
                                        {68, 191, 112},
                                        {122, 209, 81},
                                        {189, 223, 38},
                                        {253, 231, 37}}};

unsigned char between(unsigned char a, unsigned char b, double share) {
  return static_cast<unsigned char>(std::lround(a + share * (b - a)));
}

}  // namespace

Rgb viridis(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * (kViridis.size() - 1);
  const auto index = std::min(static_cast<std::size_t>(place), kViridis.size() - 2);
  const double rest = place - static_cast<double>(index);
  const Rgb& a = kViridis[index];
  const Rgb& b = kViridis[index + 1];
  return {between(a.r, b.r, rest), between(a.g, b.g, rest), between(a.b, b.b, rest)};
}

Rgb diverging(double share) {
  const double s = std::clamp(share, -1.0, 1.0);
  const Rgb full = s >= 0.0 ? Rgb{33, 102, 172} : Rgb{178, 24, 43};
  const auto mix = [&](unsigned char to) {
    return static_cast<unsigned char>(std::lround(255.0 + std::abs(s) * (to - 255.0)));
  };
  return {mix(full.r), mix(full.g), mix(full.b)};
}

}  // namespace semview::picture
