// SPDX-License-Identifier: Apache-2.0
#include "semview/map/ros_import.hpp"

#include <cmath>

#include <fmt/format.h>

#include "semview/io/pgm.hpp"
#include "semview/io/png.hpp"
#include "semview/io/yaml_document.hpp"
#include "semview/map/bundle_writer.hpp"

namespace semview::map {
namespace {

constexpr Rgb kWall{120, 120, 120};
constexpr Rgb kFloor{80, 50, 50};
constexpr Rgb kOutside{0, 0, 0};

/// map_server's reading of a grey value, mode `trinary`.
struct Thresholds {
  bool negate = false;
  double occupied = 0.65;
  double free = 0.196;
};

/// `negate` is 0 or 1 in ROS files, and sometimes false or true.
Result<bool> read_negate(const io::YamlNode& map) {
  const std::optional<io::YamlNode> node = map.find("negate");
  if (!node) return false;
  if (const Result<double> number = node->number()) return *number != 0.0;
  return node->boolean();
}

Result<Thresholds> read_thresholds(const io::YamlNode& map) {
  Thresholds thresholds;
  SEMVIEW_TRY(thresholds.negate, read_negate(map));
  SEMVIEW_TRY(thresholds.occupied, map.number_or("occupied_thresh", thresholds.occupied));
  SEMVIEW_TRY(thresholds.free, map.number_or("free_thresh", thresholds.free));
  if (!(thresholds.free >= 0.0 && thresholds.free < thresholds.occupied &&
        thresholds.occupied <= 1.0)) {
    return map.error(fmt::format("expected 0 <= free_thresh < occupied_thresh <= 1, not {} and {}",
                                 thresholds.free,
                                 thresholds.occupied));
  }
  return thresholds;
}

/// What map_saver writes for an unknown cell. With Nav2's default free_thresh of 0.25 map_server
/// would take it for free, and a whole site for one room.
constexpr std::uint8_t kSavedUnknown = 205;

Rgb class_of(std::uint8_t grey, const Thresholds& thresholds) {
  if (grey == kSavedUnknown && !thresholds.negate) return kOutside;
  const double occupancy = (thresholds.negate ? grey : 255 - grey) / 255.0;
  if (occupancy > thresholds.occupied) return kWall;
  return occupancy < thresholds.free ? kFloor : kOutside;
}

Result<Image<std::uint8_t>> read_grey(const std::filesystem::path& path) {
  return path.extension() == ".png" ? io::read_png_grey(path) : io::read_pgm(path);
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
  SEMVIEW_TRY(const io::YamlNode map, io::read_yaml(map_yaml));
  SEMVIEW_TRY(const io::YamlNode image, map.at("image"));
  SEMVIEW_TRY(const std::string image_name, image.text());
  SEMVIEW_TRY(const std::string mode, map.text_or("mode", "trinary"));
  if (mode != "trinary") {
    return map.error(fmt::format("mode {} cannot be imported, only trinary", mode));
  }
  SEMVIEW_TRY(const Thresholds thresholds, read_thresholds(map));
  SEMVIEW_TRY(const Image<std::uint8_t> grey, read_grey(map_yaml.parent_path() / image_name));

  detail::BundleText text;
  text.comment =
      fmt::format("Made by `semview map import ros` from {}.", map_yaml.filename().string());
  text.name = map_yaml.stem().string();
  SEMVIEW_TRY(const io::YamlNode resolution, map.at("resolution"));
  SEMVIEW_TRY(text.resolution_m, resolution.number());
  SEMVIEW_TRY(const io::YamlNode origin, map.at("origin"));
  SEMVIEW_TRY(const std::vector<double> numbers, origin.numbers(3));
  text.origin = {numbers[0], numbers[1], numbers[2]};
  text.ground_class = "floor";
  text.ceiling_class = "ceiling";
  text.ceiling_height_m = config.wall_height_m;
  text.outside = kOutside;
  text.classes = {make_class("floor", kFloor, 0.0),
                  make_class("wall", kWall, config.wall_height_m)};
  MapClass ceiling;
  ceiling.name = "ceiling";
  text.classes.push_back(std::move(ceiling));

  RgbImage labels(grey.rows(), grey.columns());
  for (int row = 0; row < grey.rows(); ++row) {
    for (int column = 0; column < grey.columns(); ++column) {
      labels.at(row, column) = class_of(grey.at(row, column), thresholds);
    }
  }
  return detail::write_bundle(text, labels, directory);
}

}  // namespace semview::map
