// SPDX-License-Identifier: Apache-2.0
#include "semview/simulation/path_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include <fmt/format.h>

namespace semview::simulation {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxLegs = 10000;
constexpr int kSmoothingRounds = 60;
constexpr double kSpacing_m = 0.05;

/// Cells that the robot may stand in, with a shortest-way search over them.
class Roads {
 public:
  Roads(const FreeSpace& space, const TourConfig& config) : space_(space), config_(config) {
    cost_.resize(space.free_cells().size());
    previous_.resize(cost_.size());
  }

  bool is_open(const CellIndex& cell) const {
    return space_.clearance_m(cell) >= config_.min_clearance_m;
  }

  /// Dijkstra's search from a cell to all that can be reached.
  void search(const CellIndex& start) {
    std::fill(cost_.begin(), cost_.end(), kInfinity);
    std::fill(previous_.begin(), previous_.end(), -1);
    // Ties in cost go to the lower place, so that the way is the same on every machine.
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const int origin = space_.place(start);
    cost_[static_cast<std::size_t>(origin)] = 0.0;
    open.emplace(0.0, origin);
    while (!open.empty()) {
      const auto [cost, at] = open.top();
      open.pop();
      if (cost > cost_[static_cast<std::size_t>(at)]) continue;
      const CellIndex cell = space_.free_cells()[static_cast<std::size_t>(at)];
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const CellIndex next{cell.ix + dx, cell.iy + dy};
          if ((dx == 0 && dy == 0) || !is_open(next) || !can_step(cell, next)) continue;
          const int to = space_.place(next);
          const double total = cost + step_cost(next, std::hypot(dx, dy) * PoseGrid::kCellSize_m);
          if (total < cost_[static_cast<std::size_t>(to)]) {
            cost_[static_cast<std::size_t>(to)] = total;
            previous_[static_cast<std::size_t>(to)] = at;
            open.emplace(total, to);
          }
        }
      }
    }
  }

  double cost_to(const CellIndex& cell) const {
    const int at = space_.place(cell);
    return at < 0 ? kInfinity : cost_[static_cast<std::size_t>(at)];
  }

  std::vector<CellIndex> way_to(const CellIndex& goal) const {
    std::vector<CellIndex> way;
    for (int at = space_.place(goal); at >= 0; at = previous_[static_cast<std::size_t>(at)]) {
      way.push_back(space_.free_cells()[static_cast<std::size_t>(at)]);
    }
    std::reverse(way.begin(), way.end());
    return way;
  }

 private:
  bool can_step(const CellIndex& from, const CellIndex& to) const {
    if (from.ix == to.ix || from.iy == to.iy) return space_.grid().can_step(from, to);
    const CellIndex corner{to.ix, from.iy};
    return space_.grid().can_step(from, corner) && space_.grid().can_step(corner, to);
  }

  double step_cost(const CellIndex& to, double length_m) const {
    const double lack = (config_.comfort_m - space_.clearance_m(to)) / config_.comfort_m;
    return length_m * (1.0 + 3.0 * std::max(0.0, lack));
  }

  const FreeSpace& space_;
  const TourConfig& config_;
  std::vector<double> cost_;
  std::vector<int> previous_;
};

double length_m(const std::vector<CellIndex>& way) {
  double total = 0.0;
  for (std::size_t k = 1; k < way.size(); ++k) {
    total +=
        PoseGrid::kCellSize_m * std::hypot(way[k].ix - way[k - 1].ix, way[k].iy - way[k - 1].iy);
  }
  return total;
}

/// The cells of the largest part that the robot can get about in.
std::vector<CellIndex> largest_part(const FreeSpace& space, Roads& roads) {
  std::vector<CellIndex> largest;
  std::vector<bool> seen(space.free_cells().size(), false);
  for (const CellIndex& start : space.free_cells()) {
    if (seen[static_cast<std::size_t>(space.place(start))] || !roads.is_open(start)) continue;
    roads.search(start);
    std::vector<CellIndex> part;
    for (const CellIndex& cell : space.free_cells()) {
      if (roads.cost_to(cell) == kInfinity) continue;
      seen[static_cast<std::size_t>(space.place(cell))] = true;
      part.push_back(cell);
    }
    if (part.size() > largest.size()) largest = std::move(part);
  }
  return largest;
}

/// Pulls the corners out of a line as far as the clearance allows; its ends stay.
std::vector<Point2> smooth(std::vector<Point2> line,
                           const FreeSpace& space,
                           double min_clearance_m) {
  for (int round = 0; round < kSmoothingRounds; ++round) {
    for (std::size_t k = 1; k + 1 < line.size(); ++k) {
      const Point2 moved{0.25 * line[k - 1].x_m + 0.5 * line[k].x_m + 0.25 * line[k + 1].x_m,
                         0.25 * line[k - 1].y_m + 0.5 * line[k].y_m + 0.25 * line[k + 1].y_m};
      if (space.clearance_m(moved.x_m, moved.y_m) >= min_clearance_m) line[k] = moved;
    }
  }
  return line;
}

std::vector<Point2> resample(const std::vector<Point2>& line) {
  std::vector<Point2> dense;
  for (std::size_t k = 1; k < line.size(); ++k) {
    const double dx = line[k].x_m - line[k - 1].x_m;
    const double dy = line[k].y_m - line[k - 1].y_m;
    const double pieces = std::max(1.0, std::ceil(std::hypot(dx, dy) / kSpacing_m));
    for (double i = 0.0; i < pieces; ++i) {
      dense.push_back({line[k - 1].x_m + dx * i / pieces, line[k - 1].y_m + dy * i / pieces});
    }
  }
  dense.push_back(line.back());
  return dense;
}

}  // namespace

Result<std::vector<Point2>> plan_tour(const FreeSpace& space, const TourConfig& config, Rng& rng) {
  Roads roads(space, config);
  const std::vector<CellIndex> part = largest_part(space, roads);
  if (part.size() < 2) {
    return fail(ErrorCode::kFailedPrecondition,
                fmt::format("there is no room to drive: no free cells with {} m around them",
                            config.min_clearance_m));
  }
  CellIndex here = part[rng.below(part.size())];
  std::vector<Point2> line;
  double total_m = 0.0;
  // Smoothing shortens the line: a tenth more than asked for.
  for (int leg = 0; leg < kMaxLegs && total_m < 1.1 * config.length_m; ++leg) {
    roads.search(here);
    double farthest = 0.0;
    for (const CellIndex& cell : part) farthest = std::max(farthest, roads.cost_to(cell));
    std::vector<CellIndex> goals;
    for (const CellIndex& cell : part) {
      if (roads.cost_to(cell) >= std::min(config.min_leg_m, 0.5 * farthest)) goals.push_back(cell);
    }
    const CellIndex goal = goals[rng.below(goals.size())];
    const std::vector<CellIndex> way = roads.way_to(goal);
    total_m += length_m(way);
    for (std::size_t k = line.empty() ? 0 : 1; k < way.size(); ++k) {
      const Pose2 center = PoseGrid::center(way[k]);
      // Off the grid's centres, within the cell.
      line.push_back(
          {center.x_m + rng.uniform(-0.04, 0.04), center.y_m + rng.uniform(-0.04, 0.04)});
    }
    here = goal;
  }
  return resample(smooth(std::move(line), space, config.min_clearance_m));
}

}  // namespace semview::simulation
