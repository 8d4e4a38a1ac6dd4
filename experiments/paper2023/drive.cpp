// SPDX-License-Identifier: Apache-2.0
#include "drive.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "semview/core/check.hpp"
#include "semview/core/random.hpp"

namespace semview::paper2023 {
namespace {

constexpr double kCell_m = 0.1;
constexpr double kAhead_m = 0.4;  // where a driving robot looks
constexpr double kNever = std::numeric_limits<double>::infinity();

struct Point {
  double x_m = 0.0;
  double y_m = 0.0;
};

/// Squares of 10 cm that a robot can stand on, and shortest ways between them.
class Floor {
 public:
  Floor(const Flat& flat, const DriveConfig& config)
      : columns_(static_cast<int>(flat.inside.max_x_m / kCell_m)),
        rows_(static_cast<int>(flat.inside.max_y_m / kCell_m)) {
    const paper2017::Scene scene = scene_of(flat);
    for (int cell = 0; cell < columns_ * rows_; ++cell) {
      const Point at = middle(cell);
      const auto blocked = [&](double radius_m) {
        return scene.blocked(at.x_m, at.y_m, radius_m, 0.02, config.robot_height_m);
      };
      // Some room to spare is worth a detour.
      cost_.push_back(blocked(config.robot_radius_m)         ? kNever
                      : blocked(config.robot_radius_m + 0.1) ? 3.0
                                                             : 1.0);
    }
    keep_largest_part();
  }

  Point middle(int cell) const {
    return {(cell % columns_ + 0.5) * kCell_m, (cell / columns_ + 0.5) * kCell_m};
  }

  /// A free square of an area; -1 if there is none.
  int draw(const Area& area, Rng& rng) const {
    std::vector<int> free;
    for (int cell = 0; cell < columns_ * rows_; ++cell) {
      const Point at = middle(cell);
      if (cost_[index(cell)] < kNever && at.x_m > area.min_x_m && at.x_m < area.max_x_m &&
          at.y_m > area.min_y_m && at.y_m < area.max_y_m) {
        free.push_back(cell);
      }
    }
    return free.empty() ? -1 : free[rng.below(free.size())];
  }

  /// Squares after `from`, up to `to`.
  std::vector<int> way(int from, int to) const {
    std::vector<int> before;
    costs_from(to, before);
    std::vector<int> cells;
    for (int cell = from; cell != to;) {
      cell = before[index(cell)];
      SEMVIEW_CHECK(cell >= 0);  // all free squares are of one part
      cells.push_back(cell);
    }
    return cells;
  }

 private:
  static std::size_t index(int cell) { return static_cast<std::size_t>(cell); }

  /// Cost of reaching each square, and the one before it on the way; Dijkstra.
  std::vector<double> costs_from(int from, std::vector<int>& before) const {
    std::vector<double> costs(cost_.size(), kNever);
    before.assign(cost_.size(), -1);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    costs[index(from)] = 0.0;
    open.emplace(0.0, from);
    while (!open.empty()) {
      const auto [cost, cell] = open.top();
      open.pop();
      if (cost > costs[index(cell)]) continue;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int x = cell % columns_ + dx;
          const int y = cell / columns_ + dy;
          if (x < 0 || y < 0 || x >= columns_ || y >= rows_) continue;
          const int next = y * columns_ + x;
          const double there = cost + std::hypot(dx, dy) * cost_[index(next)];
          if (!(there < costs[index(next)])) continue;
          costs[index(next)] = there;
          before[index(next)] = cell;
          open.emplace(there, next);
        }
      }
    }
    return costs;
  }

  void keep_largest_part() {
    std::vector<bool> largest(cost_.size(), false);
    std::vector<bool> seen(cost_.size(), false);
    std::ptrdiff_t most = 0;
    for (int cell = 0; cell < columns_ * rows_; ++cell) {
      if (seen[index(cell)] || cost_[index(cell)] == kNever) continue;
      std::vector<int> ignored;
      const std::vector<double> costs = costs_from(cell, ignored);
      std::vector<bool> part(cost_.size(), false);
      for (std::size_t i = 0; i < costs.size(); ++i) {
        part[i] = costs[i] < kNever;
        if (part[i]) seen[i] = true;
      }
      const std::ptrdiff_t size = std::ranges::count(part, true);
      if (size <= most) continue;
      most = size;
      largest = part;
    }
    for (std::size_t i = 0; i < cost_.size(); ++i) {
      if (!largest[i]) cost_[i] = kNever;
    }
  }

  int columns_;
  int rows_;
  std::vector<double> cost_;  ///< of a metre on it
};

/// Turns squares to drive over into the poses of images.
class Driver {
 public:
  Driver(const Floor& floor, const DriveConfig& config, int start, double yaw_rad)
      : floor_(floor), config_(config), cell_(start) {
    const Point at = floor.middle(start);
    poses_.push_back({at.x_m, at.y_m, wrap_angle(yaw_rad)});
  }

  int cell() const { return cell_; }
  double driven_m() const { return driven_m_; }
  std::vector<Pose2>& poses() { return poses_; }

  void turn_to(double yaw_rad) {
    double left_rad = wrap_angle(yaw_rad - poses_.back().yaw_rad);
    while (std::abs(left_rad) > config_.turn_rad) {
      const double turn_rad = std::copysign(config_.turn_rad, left_rad);
      turn(turn_rad);
      left_rad -= turn_rad;
    }
  }

  void look_round() {
    const int turns = static_cast<int>(std::lround(kTwoPi / config_.turn_rad));
    for (int i = 0; i < turns; ++i) turn(kTwoPi / turns);
  }

  /// Stops before `to` when the drive is `limit_m` long.
  void drive_to(int to, double limit_m) {
    std::vector<Point> way{{poses_.back().x_m, poses_.back().y_m}};
    for (const int cell : floor_.way(cell_, to)) way.push_back(floor_.middle(cell));
    const double length_m = length(way);
    const double begun_m = driven_m_;
    for (double along_m = config_.step_m; along_m <= length_m; along_m += config_.step_m) {
      if (begun_m + along_m > limit_m + 1e-9) return;
      const Point before = at(way, along_m - config_.step_m);
      const Point ahead = at(way, along_m - config_.step_m + kAhead_m);
      const double yaw_rad = std::atan2(ahead.y_m - before.y_m, ahead.x_m - before.x_m);
      turn_to(yaw_rad);
      const Point here = at(way, along_m);
      poses_.push_back({here.x_m, here.y_m, wrap_angle(yaw_rad)});
      driven_m_ = begun_m + along_m;
    }
    cell_ = to;
  }

 private:
  void turn(double by_rad) {
    Pose2 pose = poses_.back();
    pose.yaw_rad = wrap_angle(pose.yaw_rad + by_rad);
    poses_.push_back(pose);
  }

  static double length(const std::vector<Point>& way) {
    double length_m = 0.0;
    for (std::size_t i = 1; i < way.size(); ++i) {
      length_m += std::hypot(way[i].x_m - way[i - 1].x_m, way[i].y_m - way[i - 1].y_m);
    }
    return length_m;
  }

  /// The point so far along; the last one beyond the end.
  static Point at(const std::vector<Point>& way, double along_m) {
    for (std::size_t i = 1; i < way.size(); ++i) {
      const double dx = way[i].x_m - way[i - 1].x_m;
      const double dy = way[i].y_m - way[i - 1].y_m;
      const double part_m = std::hypot(dx, dy);
      if (along_m <= part_m) {
        return {way[i - 1].x_m + dx * along_m / part_m, way[i - 1].y_m + dy * along_m / part_m};
      }
      along_m -= part_m;
    }
    return way.back();
  }

  const Floor& floor_;
  const DriveConfig& config_;
  int cell_;
  double driven_m_ = 0.0;
  std::vector<Pose2> poses_;
};

/// A free square of a room, or of the flat if the room has none.
int place_in(const Floor& floor, const Flat& flat, std::size_t room, Rng& rng) {
  const int cell = floor.draw(flat.rooms[room], rng);
  return cell >= 0 ? cell : floor.draw(flat.inside, rng);
}

}  // namespace

std::vector<Pose2> plan_drive(const Flat& flat, const DriveConfig& config, std::uint64_t seed) {
  Rng rng(seed, "drive");
  const Floor floor(flat, config);
  std::size_t room = rng.below(flat.rooms.size());
  const int start = place_in(floor, flat, room, rng);
  Driver driver(floor, config, start, rng.uniform(-kPi, kPi));
  constexpr int kGoals = 50;
  for (int i = 0; i < kGoals && driver.driven_m() < config.length_m - config.step_m; ++i) {
    room = (room + 1 + rng.below(flat.rooms.size() - 1)) % flat.rooms.size();
    driver.drive_to(place_in(floor, flat, room, rng), config.length_m);
  }
  return std::move(driver.poses());
}

std::vector<Pose2> plan_survey(const Flat& flat, const DriveConfig& config, std::uint64_t seed) {
  constexpr int kPlacesPerRoom = 3;
  Rng rng(seed, "survey");
  const Floor floor(flat, config);
  Driver driver(floor, config, place_in(floor, flat, 0, rng), 0.0);
  for (const std::size_t room : {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{2}}) {
    for (int i = 0; i < kPlacesPerRoom; ++i) {
      driver.drive_to(place_in(floor, flat, room, rng), kNever);
      driver.look_round();
    }
  }
  return std::move(driver.poses());
}

std::vector<Pose2> odometry_of(const std::vector<Pose2>& map_from_base,
                               const OdometryConfig& config,
                               std::uint64_t seed) {
  Rng rng(seed, "odometry");
  const double scale = 1.0 + rng.normal(0.0, config.scale_sigma);
  std::vector<Pose2> odometry{{}};
  for (std::size_t i = 1; i < map_from_base.size(); ++i) {
    Pose2 step = inverse(map_from_base[i - 1]) * map_from_base[i];
    const double root = std::sqrt(std::hypot(step.x_m, step.y_m));
    const double slip_m = config.slip_m_per_m * root;
    step.x_m = step.x_m * scale + rng.normal(0.0, slip_m);
    step.y_m = step.y_m * scale + rng.normal(0.0, slip_m);
    const double misread = config.turn_sigma * std::abs(step.yaw_rad);
    step.yaw_rad = wrap_angle(step.yaw_rad + rng.normal(0.0, config.drift_rad_per_m * root) +
                              rng.normal(0.0, misread));
    odometry.push_back(odometry.back() * step);
  }
  return odometry;
}

}  // namespace semview::paper2023
