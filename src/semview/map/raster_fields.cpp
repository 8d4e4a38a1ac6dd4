// SPDX-License-Identifier: Apache-2.0
#include "semview/map/raster_fields.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "semview/geometry/angle.hpp"
#include "semview/map/map_limits.hpp"

namespace semview::map::detail {
namespace {

void read_resolution(MapFile& file, YamlFields& fields) {
  const auto resolution_m = fields.number("resolution", Need::kRequired, "resolution: 0.02");
  if (!resolution_m) return;
  file.resolution_m = *resolution_m;
  if (is_valid_resolution(*resolution_m)) return;
  fields.error(fields.line_of("resolution"),
               fmt::format("resolution {} m per pixel is out of limits", *resolution_m),
               fmt::format("it is within {} to {}", kMinResolution_m, kMaxResolution_m));
}

void read_origin(MapFile& file, YamlFields& fields) {
  const auto node = fields.node("origin", Need::kRequired, "origin: [0.0, 0.0, 0.0]");
  if (!node) return;
  const auto origin = fields.take(
      node->numbers(3),
      "write for example `origin: [0.0, 0.0, 0.0]`: x and y in metres, the yaw in radians");
  if (!origin) return;
  if (std::abs((*origin)[0]) > kMaxOrigin_m || std::abs((*origin)[1]) > kMaxOrigin_m ||
      std::abs((*origin)[2]) > kTwoPi) {
    fields.error(
        node->line(),
        "origin is out of limits",
        fmt::format("x and y lie within {} m of 0, the yaw within 2 pi (radians)", kMaxOrigin_m));
    return;
  }
  file.origin = {(*origin)[0], (*origin)[1], wrap_angle((*origin)[2])};
}

/// semview does not use these, but the file is for ROS tools as well, and they fail on them later.
void check_ros_only(YamlFields& fields) {
  const auto expect_one_of = [&fields](std::string_view key,
                                       const std::vector<std::string>& known) {
    const auto node = fields.node(key, Need::kOptional);
    if (!node) return;
    const Result<std::string> text = node->text();
    if (text && std::ranges::find(known, *text) != known.end()) return;
    fields.error(node->line(),
                 fmt::format("{}{} is not known to ROS", key, text ? " " + *text : std::string()),
                 fmt::format("known here: {}", fmt::join(known, ", ")));
  };
  expect_one_of("negate", {"0", "1", "false", "true"});
  expect_one_of("mode", {"trinary", "scale", "raw"});
  for (const std::string_view key : {"occupied_thresh", "free_thresh"}) {
    const auto threshold = fields.number(
        key, Need::kOptional, fmt::format("{}: {}", key, key == "free_thresh" ? "0.25" : "0.65"));
    if (!threshold || (*threshold >= 0.0 && *threshold <= 1.0)) continue;
    fields.error(fields.line_of(key),
                 fmt::format("{} {} is out of limits", key, *threshold),
                 "it is a probability, within 0 to 1");
  }
}

}  // namespace

void read_raster(MapFile& file, YamlFields& fields) {
  if (const auto image = fields.text("image", Need::kOptional, "image: occupancy.png")) {
    file.image = {*image, fields.line_of("image")};
  }
  read_resolution(file, fields);
  read_origin(file, fields);
  check_ros_only(fields);
}

}  // namespace semview::map::detail
