// SPDX-License-Identifier: Apache-2.0
#include "semview/evaluation/poses_at.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "semview/io/trajectory.hpp"

namespace semview::evaluation {

Result<std::vector<Pose2>> read_poses_at(const std::filesystem::path& path,
                                         std::span<const double> stamps_s,
                                         std::span<const double> skipped_s) {
  SEMVIEW_TRY(std::vector<io::StampedPose2> track, io::read_tum(path));
  std::erase_if(track, [skipped_s](const io::StampedPose2& pose) {
    return std::ranges::any_of(skipped_s, [&pose](double skipped) {
      return std::abs(pose.stamp_s - skipped) <= kSameStamp_s;
    });
  });
  const auto wrong = [&path](const std::string& what) {
    return fail(ErrorCode::kInvalidArgument, fmt::format("{}: {}", path.string(), what));
  };
  std::vector<Pose2> poses;
  auto given = track.begin();
  for (std::size_t i = 0; i < stamps_s.size(); ++i) {
    if (given != track.end() && given->stamp_s < stamps_s[i] - kSameStamp_s) {
      return wrong(
          fmt::format("the pose at {:.9g} s belongs to no frame; expected the {} stamps of the "
                      "frames, the next at {:.9g} s",
                      given->stamp_s,
                      stamps_s.size(),
                      stamps_s[i]));
    }
    if (given == track.end() || given->stamp_s > stamps_s[i] + kSameStamp_s) {
      return wrong(fmt::format("no pose at {:.9g} s, frame {} of {}; expected one for each",
                               stamps_s[i],
                               i + 1,
                               stamps_s.size()));
    }
    poses.push_back(given->pose);
    ++given;
  }
  if (given != track.end()) {
    return wrong(fmt::format(
        "the pose at {:.9g} s belongs to no frame; expected none after the last of {}, at {:.9g} s",
        given->stamp_s,
        stamps_s.size(),
        stamps_s.empty() ? 0.0 : stamps_s.back()));
  }
  return poses;
}

}  // namespace semview::evaluation
