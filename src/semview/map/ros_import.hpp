// SPDX-License-Identifier: Apache-2.0
/// Makes a map bundle of walls and floor from a ROS map_server map.
#pragma once

#include <filesystem>

#include "semview/core/result.hpp"

namespace semview::map {

struct RosImportConfig {
  double wall_height_m = 2.6;
};

/// Reads a map_server YAML (modes trinary, scale and raw) with its PGM or PNG and writes a bundle
/// into `directory`: occupied cells become wall, free ones floor, unknown ones outside.
/// docs/formats/map_bundle.md#importing-ros-maps says which is which.
/// @errors kNotFound, kInvalidArgument, kOutOfRange, kDataLoss: the map; kAlreadyExists:
/// `directory` holds a map already.
Status import_ros_map(const std::filesystem::path& map_yaml,
                      const std::filesystem::path& directory,
                      const RosImportConfig& config = {});

}  // namespace semview::map
