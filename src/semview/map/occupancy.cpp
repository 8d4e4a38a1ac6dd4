// SPDX-License-Identifier: Apache-2.0
#include "semview/map/occupancy.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace semview::map {
namespace {

constexpr double kStepHeight_m = 0.05;

}  // namespace

Image<std::uint8_t> occupancy_image(const ColumnMap& map, double height_m) {
  std::vector<std::uint8_t> grey;
  for (const ColumnProfile& profile : map.profiles) {
    const bool blocked =
        !profile.passable &&
        profile.reaches_into(map.ground_height_m + kStepHeight_m, map.ground_height_m + height_m);
    grey.push_back(profile.outside ? kUnknownGrey : blocked ? kOccupiedGrey : kFreeGrey);
  }
  Image<std::uint8_t> image(map.rows(), map.columns());
  for (int row = 0; row < map.rows(); ++row) {
    for (int column = 0; column < map.columns(); ++column) {
      image.at(row, column) = grey[map.profile_of_pixel.at(row, column)];
    }
  }
  return image;
}

Rgb object_color(Rgb class_color) {
  // A third of the way to black, or to white where it is dark.
  const bool dark = class_color.r + class_color.g + class_color.b < 384;
  const auto shade = [dark](std::uint8_t value) {
    return static_cast<std::uint8_t>((2 * value + (dark ? 255 : 0)) / 3);
  };
  return {shade(class_color.r), shade(class_color.g), shade(class_color.b)};
}

std::vector<Rgb> profile_colors(const SemanticMap& map, Rgb outside) {
  // Profile k is that of the k-th class with a colour; those of objects follow.
  std::vector<Rgb> colors{outside};
  for (const MapClass& details : map.class_details) {
    if (details.color) colors.push_back(*details.color);
  }
  for (const MapClass& own : map.objects.profiles) colors.push_back(*own.color);
  return colors;
}

RgbImage plan_image(const SemanticMap& map, const ColumnMap& columns) {
  std::vector<Rgb> colors = profile_colors(map, {255, 255, 255});
  std::for_each(colors.end() - static_cast<std::ptrdiff_t>(map.objects.profiles.size()),
                colors.end(),
                [](Rgb& color) { color = object_color(color); });
  RgbImage image(columns.rows(), columns.columns());
  for (int row = 0; row < columns.rows(); ++row) {
    for (int column = 0; column < columns.columns(); ++column) {
      image.at(row, column) = colors[columns.profile_of_pixel.at(row, column)];
    }
  }
  return image;
}

}  // namespace semview::map
