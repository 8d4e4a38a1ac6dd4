// SPDX-License-Identifier: Apache-2.0
#include "semview/simulation/robot_drive.hpp"

#include <algorithm>
#include <cmath>

#include "semview/geometry/angle.hpp"

namespace semview::simulation {
namespace {

/// Steering this far off its course the robot stands and turns.
constexpr double kTurnOnSpot_rad = 1.0;
constexpr double kSteeringGain_per_s = 3.0;

double distance_m(const Point2& point, const Pose2& pose) {
  return std::hypot(point.x_m - pose.x_m, point.y_m - pose.y_m);
}

/// The first point from `from` on that is `lookahead_m` away, or the last one.
std::size_t point_ahead(std::span<const Point2> line,
                        std::size_t from,
                        const Pose2& pose,
                        double lookahead_m) {
  std::size_t k = from;
  while (k + 1 < line.size() && distance_m(line[k], pose) < lookahead_m) ++k;
  return k;
}

double bearing_rad(const Pose2& pose, const Point2& target) {
  return std::atan2(target.y_m - pose.y_m, target.x_m - pose.x_m);
}

double approach(double value, double target, double step) {
  return std::clamp(target, value - step, value + step);
}

}  // namespace

std::vector<io::StampedPose2> drive(std::span<const Point2> line,
                                    double length_m,
                                    const DriveConfig& config) {
  std::vector<io::StampedPose2> poses;
  if (line.size() < 2) return poses;
  Pose2 pose{line[0].x_m, line[0].y_m, 0.0};
  std::size_t target = point_ahead(line, 0, pose, config.lookahead_m);
  pose.yaw_rad = wrap_angle(bearing_rad(pose, line[target]));
  poses.push_back({0.0, pose});
  double speed_mps = 0.0;
  double turn_radps = 0.0;
  double way_m = 0.0;
  // Even if the robot turned on the spot at every point it would be there by then.
  const auto max_ticks =
      static_cast<std::size_t>(static_cast<double>(line.size()) * 5.0 / config.tick_s);
  for (std::size_t tick = 1; tick <= max_ticks && way_m < length_m; ++tick) {
    target = point_ahead(line, target, pose, config.lookahead_m);
    if (target + 1 == line.size() && distance_m(line[target], pose) < 0.5 * config.lookahead_m)
      break;
    const double error_rad = wrap_angle(bearing_rad(pose, line[target]) - pose.yaw_rad);
    const bool turn_on_spot = std::abs(error_rad) > kTurnOnSpot_rad;
    const double along = std::max(0.0, std::cos(error_rad));
    speed_mps = approach(speed_mps,
                         turn_on_spot ? 0.0 : config.max_speed_mps * along * along,
                         (turn_on_spot ? 3.0 : 1.0) * config.max_acceleration_mps2 * config.tick_s);
    turn_radps = approach(
        turn_radps,
        std::clamp(kSteeringGain_per_s * error_rad, -config.max_turn_radps, config.max_turn_radps),
        config.max_turn_acceleration_radps2 * config.tick_s);
    const double turned_rad = turn_radps * config.tick_s;
    const double step_m = speed_mps * config.tick_s;
    // Along the arc's chord.
    const double course_rad = pose.yaw_rad + 0.5 * turned_rad;
    pose = {pose.x_m + step_m * std::cos(course_rad),
            pose.y_m + step_m * std::sin(course_rad),
            wrap_angle(pose.yaw_rad + turned_rad)};
    way_m += step_m;
    poses.push_back({static_cast<double>(tick) * config.tick_s, pose});
  }
  return poses;
}

}  // namespace semview::simulation
