// SPDX-License-Identifier: Apache-2.0
/// Reads ROS map_server maps as Nav2's map_server does. Inside the module only.
#pragma once

#include <cstdint>
#include <filesystem>

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"
#include "semview/geometry/pose2.hpp"

namespace semview::map::detail {

enum class RosCell : std::uint8_t { kUnknown, kFree, kOccupied };

struct RosMap {
  double resolution_m = 0.0;
  Pose2 origin;
  Image<RosCell> cells;  ///< as in the picture: row 0 is the uppermost
};

/// Reads the YAML file and its PGM or PNG, modes `trinary`, `scale` and `raw`.
///
/// Cells between the thresholds are undecided, hence unknown, in every mode. Differs from Nav2: in
/// mode trinary the grey 205, which map_saver writes for unknown, is unknown whatever free_thresh
/// says; `negate` and the thresholds may be missing (0, 0.65 and 0.196).
/// @errors kNotFound, kInvalidArgument, kOutOfRange, kDataLoss: with file and line.
/// @source nav2_map_server/src/map_io.cpp, loadMapFromFile.
Result<RosMap> read_ros_map(const std::filesystem::path& map_yaml);

}  // namespace semview::map::detail
