// SPDX-License-Identifier: Apache-2.0
#include "semview/map/ros_import.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "semview/map/bundle_writer.hpp"
#include "semview/map/ros_map.hpp"

namespace semview::map {
namespace {

constexpr Rgb kWall{120, 120, 120};
constexpr Rgb kFloor{80, 50, 50};
constexpr Rgb kOutside{0, 0, 0};

Rgb colour_of(detail::RosCell cell) {
  switch (cell) {
    case detail::RosCell::kOccupied:
      return kWall;
    case detail::RosCell::kFree:
      return kFloor;
    case detail::RosCell::kUnknown:
      return kOutside;
  }
  return kOutside;
}

MapClass make_class(std::string name, Rgb color, double max_height_m) {
  MapClass value;
  value.name = std::move(name);
  value.color = color;
  value.max_height_m = max_height_m;
  return value;
}

}  // namespace

Status import_ros_map(const std::filesystem::path& map_yaml,
                      const std::filesystem::path& directory,
                      const RosImportConfig& config) {
  if (!(config.wall_height_m > 0.05 && config.wall_height_m <= 100.0)) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("wall height {} m is not in (0.05, 100]", config.wall_height_m),
                      "--wall-height"});
  }
  SEMVIEW_TRY(const detail::RosMap ros, detail::read_ros_map(map_yaml));

  detail::BundleText text;
  text.comment =
      fmt::format("Made by `semview map import ros` from {}.", map_yaml.filename().string());
  text.name = map_yaml.stem().string();
  text.resolution_m = ros.resolution_m;
  text.origin = ros.origin;
  text.ground_class = "floor";
  text.ceiling_class = "ceiling";
  text.ceiling_height_m = config.wall_height_m;
  text.outside = kOutside;
  text.classes = {make_class("floor", kFloor, 0.0),
                  make_class("wall", kWall, config.wall_height_m)};
  MapClass ceiling;
  ceiling.name = "ceiling";
  text.classes.push_back(std::move(ceiling));

  RgbImage labels(ros.cells.rows(), ros.cells.columns());
  std::ranges::transform(ros.cells.pixels(), labels.pixels().begin(), colour_of);
  return detail::write_bundle(text, labels, directory);
}

}  // namespace semview::map
