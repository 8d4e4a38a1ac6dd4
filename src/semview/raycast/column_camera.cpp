// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/column_camera.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace semview::raycast {
namespace {

constexpr double kContact_m = 1e-4;
// From farther away nothing of a plan is seen: beyond it, whole cells in float would not be exact.
constexpr std::int32_t kMostCells = 1 << 21;

/// @param position  of the eye, in pixels.
EyeOnAxis eye_on_axis(double position, double resolution_m) {
  const double position_px = std::clamp(position, -1e9, 1e9);
  const double edge = std::round(position_px);
  if (std::abs(position_px - edge) * resolution_m >= kContact_m) {
    const double cell = std::floor(position_px);
    const double part = position_px - cell;
    return {{static_cast<float>(part), static_cast<float>(1.0 - part)},
            {static_cast<std::int32_t>(cell), static_cast<std::int32_t>(cell)}};
  }
  const auto past = static_cast<float>(position_px - edge);
  const auto cell = static_cast<std::int32_t>(edge);
  return {{past, -past}, {cell, cell - 1}};
}

/// One axis of a ray from an eye past the grid.
struct Approach {
  float slope;
  float behind;
  std::int32_t cell;  // the eye's
  int cells;
  bool falls;

  Approach(const EyeOnAxis& eye, float signed_slope, int cells_in_all)
      : slope(std::abs(signed_slope)), cells(cells_in_all), falls(signed_slope < 0.0F) {
    behind = eye.behind[falls ? 1 : 0];
    cell = eye.cell[falls ? 1 : 0];
  }
  /// Of cells before the grid begins, and before it ends; negative behind the eye.
  std::int32_t first() const { return falls ? cell - (cells - 1) : -cell; }
  std::int32_t end() const { return first() + cells; }
  float enters_m() const {
    if (first() <= 0) return 0.0F;
    return slope > 0.0F ? (static_cast<float>(first()) - behind) / slope : -1.0F;
  }
  std::int32_t at(float distance_m) const {
    const float there = std::min(distance_m * slope + behind, static_cast<float>(end()));
    return std::max({std::int32_t{0}, first(), static_cast<std::int32_t>(there)});
  }
};

/// Lets a ray begin where it meets the grid, or on the border.
void begin(ColumnRays& rays, std::size_t ray, int columns, int rows) {
  const Approach u(rays.u, rays.slope_u[ray], columns);
  const Approach v(rays.v, rays.slope_v[ray], rows);
  const float enters_u = u.enters_m();
  const float enters_v = v.enters_m();
  const float enters_m = std::max(enters_u, enters_v);
  const bool meets =
      enters_u >= 0.0F && enters_v >= 0.0F && std::max(u.end(), v.end()) <= kMostCells;
  rays.begin_u[ray] = enters_u == enters_m ? std::max(0, u.first()) : u.at(enters_m);
  rays.begin_v[ray] = enters_v == enters_m ? std::max(0, v.first()) : v.at(enters_m);
  rays.begins_at_m[ray] = enters_m;
  if (meets && rays.begin_u[ray] < u.end() && rays.begin_v[ray] < v.end()) return;
  rays.begin_u[ray] = u.first() - 1;
  rays.begin_v[ray] = v.first() - 1;
  rays.begins_at_m[ray] = 0.0F;
}

bool on_grid(const EyeOnAxis& eye, int cells) {
  return std::ranges::all_of(eye.cell,
                             [cells](std::int32_t cell) { return cell >= 0 && cell < cells; });
}

}  // namespace

ColumnCamera::ColumnCamera(const PanoramaCamera& camera) : camera_(camera), rows_(camera) {
  for (int c = 0; c < camera.columns; ++c) {
    cosines_.push_back(std::cos(camera.azimuth_rad(c)));
    sines_.push_back(std::sin(camera.azimuth_rad(c)));
  }
  for (int r = 0; r < camera.rows; ++r) {
    secants_.push_back(static_cast<float>(1.0 / std::cos(camera.elevation_rad(r))));
    cosecants_.push_back(static_cast<float>(1.0 / std::sin(camera.elevation_rad(r))));
  }
  const std::size_t padded =
      (cosines_.size() + ColumnRays::kPadding - 1) / ColumnRays::kPadding * ColumnRays::kPadding;
  cosines_.resize(padded, cosines_.back());
  sines_.resize(padded, sines_.back());
}

void ColumnCamera::aim(const ColumnScene& scene,
                       const PanoramaRequest& request,
                       ColumnRays& rays) const {
  const map::ColumnMap& plan = scene.plan();
  const ColumnGrid& grid = scene.grid();
  const Pose2& pose = request.map_from_robot;
  const Eigen::Vector2d eye = plan.plan_from_map(pose.x_m, pose.y_m) / grid.resolution_m;
  rays.u = eye_on_axis(eye.x(), grid.resolution_m);
  rays.v = eye_on_axis(eye.y(), grid.resolution_m);
  const bool between = request.eye_z_m > grid.ground_m && request.eye_z_m < grid.top_m;
  rays.through_closed = !between;

  // Cells from robot: turned by the yaw, drawn by the affine, turned back by the plan's origin.
  const auto cells_from_robot = [&](double x, double y) {
    const double c = std::cos(pose.yaw_rad);
    const double s = std::sin(pose.yaw_rad);
    const Eigen::Vector3d drawn = request.affine.apply({c * x - s * y, s * x + c * y, 0.0});
    const double plan_c = std::cos(plan.origin.yaw_rad) / grid.resolution_m;
    const double plan_s = std::sin(plan.origin.yaw_rad) / grid.resolution_m;
    return Eigen::Vector2d(plan_c * drawn.x() + plan_s * drawn.y(),
                           plan_c * drawn.y() - plan_s * drawn.x());
  };
  const Eigen::Vector2d along = cells_from_robot(1.0, 0.0);
  const Eigen::Vector2d across = cells_from_robot(0.0, 1.0);
  const std::size_t padded = cosines_.size();
  rays.count = static_cast<std::size_t>(camera_.columns);
  rays.slope_u.resize(padded);
  rays.slope_v.resize(padded);
  for (std::size_t i = 0; i < padded; ++i) {
    rays.slope_u[i] = static_cast<float>(along.x() * cosines_[i] + across.x() * sines_[i]);
    rays.slope_v[i] = static_cast<float>(along.y() * cosines_[i] + across.y() * sines_[i]);
  }
  rays.begin_u.assign(padded, 0);
  rays.begin_v.assign(padded, 0);
  rays.begins_at_m.assign(padded, 0.0F);
  if (on_grid(rays.u, grid.columns) && on_grid(rays.v, grid.rows)) return;
  for (std::size_t i = 0; i < padded; ++i) begin(rays, i, grid.columns, grid.rows);
}

}  // namespace semview::raycast
