// SPDX-License-Identifier: Apache-2.0
/// Trajectories in the text format of the TUM RGB-D benchmark, as planar poses and as poses in
/// space.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include <Eigen/Geometry>

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

struct StampedPose3 {
  double stamp_s = 0.0;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

/// Reads the same lines with height and tilt. A pose that is not finite stays in its place:
/// trackers write it where they were lost.
/// @errors as `read_tum`, but for the pose's numbers that are not finite.
Result<std::vector<StampedPose3>> read_tum_poses(const std::filesystem::path& path);

/// Writes poses in space with 9 decimals.
/// @errors kUnavailable: the file cannot be written.
Status write_tum_poses(const std::filesystem::path& path, std::span<const StampedPose3> poses);

/// The pose at `stamp_s`: a sample's own, or between the two samples around it, position linearly
/// and rotation along the shorter way. `poses` must be in order of stamps.
/// @errors kOutOfRange: no poses, `stamp_s` before the first or after the last, between two that
/// are more than `max_gap_s` apart, or next to one that is not finite.
Result<Eigen::Isometry3d> interpolate(std::span<const StampedPose3> poses,
                                      double stamp_s,
                                      double max_gap_s);

}  // namespace semview::io
