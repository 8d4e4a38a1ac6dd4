// SPDX-License-Identifier: Apache-2.0
/// Another program's trajectory, held against the moments that it was asked for.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/pose2.hpp"

namespace semview::evaluation {

/// A stamp counts as that of a frame within this: programs print stamps with few decimals.
inline constexpr double kSameStamp_s = 0.001;

/// The poses of a TUM file, one for each of `stamps_s` and no other, in their order. Nothing is
/// interpolated: a pose that the program did not give is not made up.
/// @param stamps_s  rising, further apart than `kSameStamp_s`
/// @param skipped_s  poses at these stamps may be there and are passed over
/// @errors those of `io::read_tum`; kInvalidArgument: a stamp without a pose, or a pose whose stamp
/// is none of them.
Result<std::vector<Pose2>> read_poses_at(const std::filesystem::path& path,
                                         std::span<const double> stamps_s,
                                         std::span<const double> skipped_s = {});

}  // namespace semview::evaluation
