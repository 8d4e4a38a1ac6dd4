// SPDX-License-Identifier: Apache-2.0
#include "semview/io/trajectory.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "semview/io/text_file.hpp"

namespace semview::io {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 30U;

/// Stamp, position and quaternion as they stand in a line.
using Numbers = std::array<double, 8>;

/// The eight numbers of a line, or false.
bool parse_line(std::string_view line, Numbers& numbers) {
  constexpr std::string_view kSpace = " \t\r";
  for (double& number : numbers) {
    line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
    const auto [stop, status] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (status != std::errc()) return false;
    line.remove_prefix(static_cast<std::size_t>(stop - line.data()));
    if (!line.empty() && kSpace.find(line.front()) == std::string_view::npos) return false;
  }
  return line.find_first_not_of(kSpace) == std::string_view::npos;
}

bool all_finite(const Numbers& numbers) {
  return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
}

/// @param lost_allowed  Numbers of a pose need not be finite; its stamp must be.
Result<std::vector<Numbers>> read_lines(const std::filesystem::path& path, bool lost_allowed) {
  SEMVIEW_TRY(const std::string text, read_text_file(path, kMaxBytes));
  std::vector<Numbers> lines;
  std::string_view rest = text;
  for (int line_number = 1; !rest.empty(); ++line_number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || line[first] == '#') continue;
    const auto wrong = [&](const std::string& what) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}:{}: {}", path.string(), line_number, what));
    };
    Numbers n{};
    if (!parse_line(line, n) || !std::isfinite(n[0]) || (!lost_allowed && !all_finite(n))) {
      return wrong("expected eight finite numbers: stamp tx ty tz qx qy qz qw");
    }
    const double length = std::sqrt(n[4] * n[4] + n[5] * n[5] + n[6] * n[6] + n[7] * n[7]);
    if (all_finite(n) && !(std::abs(length - 1.0) <= 0.01)) {
      return wrong(fmt::format("quaternion of length {:g}, expected 1", length));
    }
    if (!lines.empty() && n[0] <= lines.back()[0]) {
      return wrong(fmt::format(
          "stamp {:.9f} is not above {:.9f} of the pose before", n[0], lines.back()[0]));
    }
    lines.push_back(n);
  }
  if (lines.empty()) {
    return fail(ErrorCode::kInvalidArgument, fmt::format("{}: holds no pose", path.string()));
  }
  return lines;
}

}  // namespace

Result<std::vector<StampedPose2>> read_tum(const std::filesystem::path& path) {
  SEMVIEW_TRY(const std::vector<Numbers> lines, read_lines(path, false));
  std::vector<StampedPose2> poses;
  poses.reserve(lines.size());
  for (const Numbers& n : lines) {
    // Rotating the x axis; scale cancels in atan2.
    const double yaw_rad = std::atan2(2.0 * (n[7] * n[6] + n[4] * n[5]),
                                      n[7] * n[7] + n[4] * n[4] - n[5] * n[5] - n[6] * n[6]);
    poses.push_back({n[0], {n[1], n[2], wrap_angle(yaw_rad)}});
  }
  return poses;
}

Result<std::vector<StampedPose3>> read_tum_poses(const std::filesystem::path& path) {
  SEMVIEW_TRY(const std::vector<Numbers> lines, read_lines(path, true));
  std::vector<StampedPose3> poses;
  poses.reserve(lines.size());
  for (const Numbers& n : lines) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::Quaterniond(n[7], n[4], n[5], n[6]).normalized().toRotationMatrix();
    pose.translation() = Eigen::Vector3d(n[1], n[2], n[3]);
    poses.push_back({n[0], pose});
  }
  return poses;
}

Status write_tum(const std::filesystem::path& path, std::span<const StampedPose2> poses) {
  std::string text = "# stamp tx ty tz qx qy qz qw\n";
  for (const StampedPose2& sample : poses) {
    // Adding 0.0 turns -0.0 into 0.0, which would print with a sign.
    text += fmt::format("{:.9f} {:.9f} {:.9f} 0 0 0 {:.9f} {:.9f}\n",
                        sample.stamp_s,
                        sample.pose.x_m + 0.0,
                        sample.pose.y_m + 0.0,
                        std::sin(sample.pose.yaw_rad / 2.0) + 0.0,
                        std::cos(sample.pose.yaw_rad / 2.0) + 0.0);
  }
  return write_text_file(path, text);
}

Status write_tum_poses(const std::filesystem::path& path, std::span<const StampedPose3> poses) {
  std::string text = "# stamp tx ty tz qx qy qz qw\n";
  for (const StampedPose3& sample : poses) {
    const Eigen::Quaterniond q(sample.pose.linear());
    const Eigen::Vector3d t = sample.pose.translation();
    text += fmt::format("{:.9f}", sample.stamp_s);
    for (const double number : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
      text += fmt::format(" {:.9f}", number + 0.0);
    }
    text += '\n';
  }
  return write_text_file(path, text);
}

Result<Pose2> interpolate(std::span<const StampedPose2> poses, double stamp_s) {
  if (poses.empty() || !(stamp_s >= poses.front().stamp_s && stamp_s <= poses.back().stamp_s)) {
    return fail(ErrorCode::kOutOfRange,
                poses.empty() ? fmt::format("no pose at {:.9f} s: the trajectory is empty", stamp_s)
                              : fmt::format("no pose at {:.9f} s: the trajectory covers {:.9f} to "
                                            "{:.9f} s",
                                            stamp_s,
                                            poses.front().stamp_s,
                                            poses.back().stamp_s));
  }
  const auto after = std::ranges::lower_bound(poses, stamp_s, {}, &StampedPose2::stamp_s);
  if (after->stamp_s == stamp_s) return after->pose;
  const auto before = after - 1;
  const double share = (stamp_s - before->stamp_s) / (after->stamp_s - before->stamp_s);
  const Pose2& a = before->pose;
  const Pose2& b = after->pose;
  return Pose2{a.x_m + share * (b.x_m - a.x_m),
               a.y_m + share * (b.y_m - a.y_m),
               wrap_angle(a.yaw_rad + share * wrap_angle(b.yaw_rad - a.yaw_rad))};
}

Result<Eigen::Isometry3d> interpolate(std::span<const StampedPose3> poses,
                                      double stamp_s,
                                      double max_gap_s) {
  const auto none = [stamp_s](const std::string& why) {
    return fail(ErrorCode::kOutOfRange, fmt::format("no pose at {:.9f} s: {}", stamp_s, why));
  };
  const auto after = std::ranges::lower_bound(poses, stamp_s, {}, &StampedPose3::stamp_s);
  const bool own = after != poses.end() && after->stamp_s == stamp_s;
  if (after == poses.end() || (after == poses.begin() && !own)) {
    return none("outside the trajectory");
  }
  const auto before = own ? after : after - 1;
  if (!before->pose.matrix().allFinite() || !after->pose.matrix().allFinite()) {
    return none("the trajectory was lost there");
  }
  if (own) return after->pose;
  const double gap_s = after->stamp_s - before->stamp_s;
  if (gap_s > max_gap_s) {
    return none(fmt::format(
        "the poses around it are {:.3f} s apart, expected up to {:.3f} s", gap_s, max_gap_s));
  }
  const double share = (stamp_s - before->stamp_s) / gap_s;
  Eigen::Isometry3d between = Eigen::Isometry3d::Identity();
  between.linear() = Eigen::Quaterniond(before->pose.linear())
                         .slerp(share, Eigen::Quaterniond(after->pose.linear()))
                         .toRotationMatrix();
  between.translation() =
      before->pose.translation() + share * (after->pose.translation() - before->pose.translation());
  return between;
}

}  // namespace semview::io
