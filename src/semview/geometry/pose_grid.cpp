// SPDX-License-Identifier: Apache-2.0
#include "semview/geometry/pose_grid.hpp"

#include <cmath>

namespace semview {
namespace {

constexpr double kHeadingStep_rad = kTwoPi / PoseGrid::kHeadings;
constexpr double kCellsPerMetre = 10.0;

}  // namespace

std::optional<CellIndex> PoseGrid::cell(double x_m, double y_m) {
  // Written so that NaN fails too.
  if (!(std::abs(x_m) <= kMaxCoordinate_m && std::abs(y_m) <= kMaxCoordinate_m)) return {};
  return CellIndex{static_cast<std::int32_t>(std::floor(x_m * kCellsPerMetre)),
                   static_cast<std::int32_t>(std::floor(y_m * kCellsPerMetre))};
}

int PoseGrid::heading(double yaw_rad) {
  const double steps = std::floor(wrap_angle(yaw_rad) / kHeadingStep_rad + 0.5);
  const int index = static_cast<int>(steps) % kHeadings;
  return index < 0 ? index + kHeadings : index;
}

std::optional<GridKey> PoseGrid::key(const Pose2& pose) {
  const std::optional<CellIndex> index = cell(pose.x_m, pose.y_m);
  if (!index || !std::isfinite(pose.yaw_rad)) return {};
  return GridKey{*index, heading(pose.yaw_rad)};
}

Pose2 PoseGrid::center(const CellIndex& cell) {
  return {(cell.ix + 0.5) / kCellsPerMetre, (cell.iy + 0.5) / kCellsPerMetre, 0.0};
}

Pose2 PoseGrid::center(const GridKey& key) {
  Pose2 pose = center(key.cell);
  pose.yaw_rad = heading_yaw_rad(key.heading);
  return pose;
}

double PoseGrid::heading_yaw_rad(int heading) { return wrap_angle(heading * kHeadingStep_rad); }

}  // namespace semview
