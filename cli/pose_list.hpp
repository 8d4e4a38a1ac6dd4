// SPDX-License-Identifier: Apache-2.0
/// Poses as people write them: x, y in metres and yaw in degrees.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/pose2.hpp"

namespace semview::cli {

/// `X,Y,YAW_DEG`, the value of `option`.
/// @errors kInvalidArgument, with the option as the field.
Result<Pose2> parse_pose(std::string_view option, const std::string& text);

/// A file with `x,y,yaw_deg` a line; lines that start with # and a first line of names are skipped.
/// @errors kNotFound; kInvalidArgument with file and line; kResourceExhausted: above 64 MB.
Result<std::vector<Pose2>> read_pose_list(const std::filesystem::path& path);

}  // namespace semview::cli
