// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/class_palette.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace semview::picture {
namespace {

struct NamedColour {
  std::string_view name;
  Rgb colour;
};

// Surfaces of the building in quiet colours, what stands in it in stronger ones.
constexpr std::array kNamed{
    NamedColour{"wall", {176, 178, 184}},    NamedColour{"floor", {150, 116, 84}},
    NamedColour{"ceiling", {236, 231, 218}}, NamedColour{"door", {226, 139, 55}},
    NamedColour{"window", {143, 199, 232}},  NamedColour{"windowpane", {143, 199, 232}},
    NamedColour{"stairs", {133, 98, 160}},   NamedColour{"stairway", {133, 98, 160}},
    NamedColour{"railing", {94, 107, 119}},  NamedColour{"column", {120, 132, 122}},
    NamedColour{"table", {196, 62, 62}},     NamedColour{"coffee table", {222, 112, 102}},
    NamedColour{"desk", {168, 44, 92}},      NamedColour{"chair", {62, 125, 190}},
    NamedColour{"armchair", {76, 92, 178}},  NamedColour{"sofa", {48, 150, 140}},
    NamedColour{"bed", {112, 160, 66}},      NamedColour{"cabinet", {205, 172, 52}},
    NamedColour{"wardrobe", {180, 148, 40}}, NamedColour{"shelf", {214, 190, 100}},
    NamedColour{"bookcase", {190, 166, 84}}, NamedColour{"countertop", {108, 72, 52}},
    NamedColour{"sink", {72, 176, 210}},     NamedColour{"toilet", {232, 160, 200}},
    NamedColour{"bathtub", {120, 208, 200}}, NamedColour{"curtain", {206, 130, 178}},
    NamedColour{"lamp", {250, 214, 92}},     NamedColour{"plant", {58, 128, 62}},
    NamedColour{"person", {232, 58, 110}},   NamedColour{"refrigerator", {92, 150, 176}},
};

/// Hues a golden angle apart never come close to each other.
Rgb spread_colour(int index) {
  const double hue = std::fmod(0.12 + index * 0.61803398875, 1.0) * 6.0;
  const double value = index % 2 == 0 ? 0.86 : 0.66;
  const double low = value * 0.36;
  const double rise = low + (value - low) * (1.0 - std::abs(std::fmod(hue, 2.0) - 1.0));
  const std::array<std::array<double, 3>, 6> sectors{{{value, rise, low},
                                                      {rise, value, low},
                                                      {low, value, rise},
                                                      {low, rise, value},
                                                      {rise, low, value},
                                                      {value, low, rise}}};
  const auto& sector = sectors[std::min(static_cast<std::size_t>(hue), sectors.size() - 1)];
  const auto byte = [](double part) { return static_cast<unsigned char>(std::lround(part * 255)); };
  return {byte(sector[0]), byte(sector[1]), byte(sector[2])};
}

}  // namespace

ClassPalette ClassPalette::for_classes(const ClassTable& classes) {
  ClassPalette palette;
  palette.colours_.fill({128, 128, 128});
  palette.set(kNoHit, {248, 248, 246});
  int strangers = 0;
  for (int id = 1; id <= classes.size(); ++id) {
    const std::string_view name = classes.name(static_cast<ClassId>(id));
    const auto* known = std::ranges::find(kNamed, name, &NamedColour::name);
    palette.set(static_cast<ClassId>(id),
                known != kNamed.end() ? known->colour : spread_colour(strangers++));
  }
  return palette;
}

}  // namespace semview::picture
