// SPDX-License-Identifier: Apache-2.0
/// Trajectories in the text format of the TUM RGB-D benchmark, read as planar poses.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/pose2.hpp"

namespace semview::io {

struct StampedPose2 {
  double stamp_s = 0.0;
  Pose2 pose;

  bool operator==(const StampedPose2&) const = default;
};

/// Reads lines `stamp tx ty tz qx qy qz qw` (s, m, unit quaternion); `#` begins a comment. Height,
/// roll and pitch are dropped: the yaw is the direction of the x axis, seen from above.
/// @errors kNotFound: cannot be read; kInvalidArgument with file and line: not eight finite
/// numbers, a quaternion whose length is not 1 to within 1 %, or a stamp not above the one before;
/// kInvalidArgument: no pose at all.
Result<std::vector<StampedPose2>> read_tum(const std::filesystem::path& path);

/// Writes poses with z = 0 and 9 decimals: equal poses make equal bytes on every machine.
/// @errors kUnavailable: the file cannot be written.
Status write_tum(const std::filesystem::path& path, std::span<const StampedPose2> poses);

/// The pose at `stamp_s`, between the two samples around it: position linearly, yaw along the
/// shorter way. `poses` must be in order of stamps. At a sample's own stamp it is that sample.
/// @errors kOutOfRange: no poses, or `stamp_s` before the first or after the last.
Result<Pose2> interpolate(std::span<const StampedPose2> poses, double stamp_s);

}  // namespace semview::io
