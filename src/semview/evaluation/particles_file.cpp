// SPDX-License-Identifier: Apache-2.0
#include "semview/evaluation/particles_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "semview/io/text_file.hpp"

namespace semview::evaluation {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{256} << 20U;
constexpr std::string_view kHeader = "x_m,y_m,yaw_deg";

bool parse_first_three(std::string_view line, std::array<double, 3>& numbers) {
  for (double& number : numbers) {
    const auto [stop, status] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (status != std::errc()) return false;
    line.remove_prefix(static_cast<std::size_t>(stop - line.data()));
    if (!line.empty() && line.front() != ',') return false;
    line.remove_prefix(std::min<std::size_t>(1, line.size()));
  }
  return true;
}

}  // namespace

Result<std::vector<Pose2>> read_particles(const std::filesystem::path& path) {
  SEMVIEW_TRY(const std::string text, io::read_text_file(path, kMaxBytes));
  std::vector<Pose2> poses;
  std::string_view rest = text;
  for (int line_number = 1; !rest.empty(); ++line_number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    const auto wrong = [&](std::string_view what) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}:{}: {}", path.string(), line_number, what));
    };
    if (line_number == 1) {
      if (!line.starts_with(kHeader)) return wrong("expected a header that begins x_m,y_m,yaw_deg");
      continue;
    }
    if (line.empty()) continue;
    std::array<double, 3> numbers{};
    if (!parse_first_three(line, numbers)) return wrong("expected the numbers x_m,y_m,yaw_deg");
    const Pose2 pose{numbers[0], numbers[1], rad_from_deg(numbers[2])};
    if (!is_finite(pose)) return wrong("a number is not finite");
    poses.push_back({pose.x_m, pose.y_m, wrap_angle(pose.yaw_rad)});
  }
  return poses;
}

}  // namespace semview::evaluation
