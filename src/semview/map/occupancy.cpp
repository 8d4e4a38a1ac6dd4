// SPDX-License-Identifier: Apache-2.0
#include "semview/map/occupancy.hpp"

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

RgbImage plan_image(const SemanticMap& map, const ColumnMap& columns) {
  // Profile k is that of the k-th class with a colour.
  std::vector<Rgb> colors{Rgb{255, 255, 255}};
  for (const MapClass& details : map.class_details) {
    if (details.color) colors.push_back(*details.color);
  }
  RgbImage image(columns.rows(), columns.columns());
  for (int row = 0; row < columns.rows(); ++row) {
    for (int column = 0; column < columns.columns(); ++column) {
      image.at(row, column) = colors[columns.profile_of_pixel.at(row, column)];
    }
  }
  return image;
}

}  // namespace semview::map
