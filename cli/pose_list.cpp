// SPDX-License-Identifier: Apache-2.0
#include "pose_list.hpp"

#include <cctype>
#include <fstream>

#include <fmt/format.h>

#include "semview/geometry/angle.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

constexpr std::uintmax_t kMaxPoseFileBytes = 64U << 20U;

Pose2 pose_of(const std::vector<double>& numbers) {
  return {numbers[0], numbers[1], wrap_angle(rad_from_deg(numbers[2]))};
}

}  // namespace

Result<Pose2> parse_pose(std::string_view option, const std::string& text) {
  SEMVIEW_TRY(const std::vector<double> numbers, parse_numbers(option, text, 3));
  return pose_of(numbers);
}

Result<std::vector<Pose2>> read_pose_list(const std::filesystem::path& path) {
  std::error_code no_size;
  const std::uintmax_t size = std::filesystem::file_size(path, no_size);
  std::ifstream file(path);
  if (no_size || !file) {
    return fail(ErrorCode::kNotFound, fmt::format("{}: cannot be read as a file", path.string()));
  }
  if (size > kMaxPoseFileBytes) {
    return fail(
        ErrorCode::kResourceExhausted,
        fmt::format("{}: {} bytes, expected at most {}", path.string(), size, kMaxPoseFileBytes));
  }
  std::vector<Pose2> poses;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    std::erase_if(line, [](unsigned char c) { return std::isspace(c) != 0; });
    const bool names =
        poses.empty() && !line.empty() && std::isalpha(static_cast<unsigned char>(line[0])) != 0;
    if (line.empty() || line.starts_with('#') || names) continue;
    const auto numbers = parse_numbers("", line, 3);
    if (!numbers) {
      return fail(
          ErrorCode::kInvalidArgument,
          fmt::format("{}:{}: expected x,y,yaw_deg, found '{}'", path.string(), number, line));
    }
    poses.push_back(pose_of(*numbers));
  }
  if (poses.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: no poses, expected lines of x,y,yaw_deg", path.string()));
  }
  return poses;
}

}  // namespace semview::cli
