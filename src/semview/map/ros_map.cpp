// SPDX-License-Identifier: Apache-2.0
#include "semview/map/ros_map.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "semview/geometry/angle.hpp"
#include "semview/io/pgm.hpp"
#include "semview/io/png.hpp"
#include "semview/io/yaml_document.hpp"
#include "semview/map/map_limits.hpp"

namespace semview::map::detail {
namespace {

enum class Mode { kTrinary, kScale, kRaw };

/// How a pixel is read.
struct Reading {
  Mode mode = Mode::kTrinary;
  bool negate = false;
  double occupied = 0.65;
  double free = 0.196;
};

Result<Mode> read_mode(const io::YamlNode& map) {
  const std::optional<io::YamlNode> node = map.find("mode");
  if (!node) return Mode::kTrinary;
  SEMVIEW_TRY(const std::string mode, node->text());
  if (mode == "trinary") return Mode::kTrinary;
  if (mode == "scale") return Mode::kScale;
  if (mode == "raw") return Mode::kRaw;
  return node->error(fmt::format("mode '{}' is not trinary, scale or raw", mode));
}

/// `negate` is 0 or 1 in ROS files, and sometimes false or true.
Result<bool> read_negate(const io::YamlNode& map) {
  const std::optional<io::YamlNode> node = map.find("negate");
  if (!node) return false;
  if (const Result<double> number = node->number()) return *number != 0.0;
  return node->boolean();
}

/// A threshold, or `otherwise` where the file leaves it out.
Result<double> read_threshold(const io::YamlNode& map, std::string_view key, double otherwise) {
  const std::optional<io::YamlNode> node = map.find(key);
  if (!node) return otherwise;
  SEMVIEW_TRY(const double value, node->number());
  if (value >= 0.0 && value <= 1.0) return value;
  return node->error(fmt::format("{} {} is not in 0..1", key, value));
}

Result<Reading> read_reading(const io::YamlNode& map) {
  Reading reading;
  SEMVIEW_TRY(reading.mode, read_mode(map));
  SEMVIEW_TRY(reading.negate, read_negate(map));
  SEMVIEW_TRY(reading.occupied, read_threshold(map, "occupied_thresh", reading.occupied));
  SEMVIEW_TRY(reading.free, read_threshold(map, "free_thresh", reading.free));
  if (reading.free < reading.occupied) return reading;
  const io::YamlNode place =
      map.find("free_thresh").value_or(map.find("occupied_thresh").value_or(map));
  return place.error(fmt::format(
      "free_thresh {} is not below occupied_thresh {}", reading.free, reading.occupied));
}

Result<double> read_resolution(const io::YamlNode& map) {
  SEMVIEW_TRY(const io::YamlNode node, map.at("resolution"));
  SEMVIEW_TRY(const double resolution_m, node.number());
  if (is_valid_resolution(resolution_m)) return resolution_m;
  return node.error(fmt::format("resolution {} m per pixel is not in {}..{}",
                                resolution_m,
                                kMinResolution_m,
                                kMaxResolution_m));
}

Result<Pose2> read_origin(const io::YamlNode& map) {
  SEMVIEW_TRY(const io::YamlNode node, map.at("origin"));
  SEMVIEW_TRY(const std::vector<double> numbers, node.numbers(3));
  if (std::abs(numbers[0]) <= kMaxOrigin_m && std::abs(numbers[1]) <= kMaxOrigin_m &&
      std::abs(numbers[2]) <= kTwoPi) {
    return Pose2{numbers[0], numbers[1], numbers[2]};
  }
  return node.error(fmt::format(
      "origin is out of limits: x and y lie within {} m of 0, the yaw within 2 pi (radians)",
      kMaxOrigin_m));
}

/// What map_saver writes for an unknown cell in mode trinary. Its occupancy of 0.196 is below the
/// free_thresh of 0.25 that Nav2's map_saver writes beside it: map_server would take it for free,
/// and a whole site for one room.
constexpr io::Rgba kSavedUnknown{205, 205, 205, 255};

RosCell decide(double occupancy, const Reading& reading) {
  if (occupancy > reading.occupied) return RosCell::kOccupied;
  return occupancy < reading.free ? RosCell::kFree : RosCell::kUnknown;
}

RosCell cell_of(io::Rgba pixel, bool has_alpha, const Reading& reading) {
  const double sum = static_cast<double>(pixel.r) + pixel.g + pixel.b;
  // map_server lets alpha take part in the mean in mode trinary.
  const bool mean_with_alpha = has_alpha && reading.mode == Mode::kTrinary;
  const double grey = mean_with_alpha ? (sum + pixel.a) / 4.0 : sum / 3.0;
  switch (reading.mode) {
    case Mode::kTrinary:
      if (pixel == kSavedUnknown && !reading.negate) return RosCell::kUnknown;
      break;
    case Mode::kScale:
      if (pixel.a != 255) return RosCell::kUnknown;
      break;
    case Mode::kRaw: {
      // The grey is a percentage as it is, `negate` or not; above 100 it says unknown.
      const double percent = std::round(grey);
      return percent > 100.0 ? RosCell::kUnknown : decide(percent / 100.0, reading);
    }
  }
  return decide(reading.negate ? grey / 255.0 : 1.0 - grey / 255.0, reading);
}

bool is_png(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(
      ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".png";
}

Result<Image<RosCell>> read_cells(const std::filesystem::path& path, const Reading& reading) {
  const auto read_from = [&](const auto& pixels, const auto& cell) {
    Image<RosCell> cells(pixels.rows(), pixels.columns());
    std::ranges::transform(pixels.pixels(), cells.pixels().begin(), cell);
    return cells;
  };
  if (is_png(path)) {
    SEMVIEW_TRY(const io::RgbaPicture picture, io::read_png_rgba(path));
    return read_from(picture.pixels,
                     [&](io::Rgba pixel) { return cell_of(pixel, picture.has_alpha, reading); });
  }
  SEMVIEW_TRY(const Image<std::uint8_t> greys, io::read_pgm(path));
  return read_from(greys, [&](std::uint8_t grey) {
    return cell_of({grey, grey, grey, 255}, false, reading);
  });
}

}  // namespace

Result<RosMap> read_ros_map(const std::filesystem::path& map_yaml) {
  SEMVIEW_TRY(const io::YamlNode map, io::read_yaml(map_yaml));
  SEMVIEW_TRY(const io::YamlNode image, map.at("image"));
  SEMVIEW_TRY(const std::string image_name, image.text());
  SEMVIEW_TRY(const Reading reading, read_reading(map));
  RosMap ros;
  SEMVIEW_TRY(ros.resolution_m, read_resolution(map));
  SEMVIEW_TRY(ros.origin, read_origin(map));
  const std::filesystem::path path = map_yaml.parent_path() / image_name;
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return image.error(fmt::format("image {} is not there", path.string()));
  }
  SEMVIEW_TRY(ros.cells, read_cells(path, reading));
  return ros;
}

}  // namespace semview::map::detail
