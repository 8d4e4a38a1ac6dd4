// SPDX-License-Identifier: Apache-2.0
#include "semview/map/column_map.hpp"

#include <algorithm>
#include <cmath>

namespace semview::map {
namespace {

/// A point this far (in pixels) left of a pixel's edge counts as on it: decimal origins and
/// resolutions put points that should lie on edges a rounding error beside them.
constexpr double kEdgeSlack_px = 1e-9;

}  // namespace

Eigen::Vector2d ColumnMap::plan_from_map(double x_m, double y_m) const {
  const double c = std::cos(origin.yaw_rad);
  const double s = std::sin(origin.yaw_rad);
  const double dx = x_m - origin.x_m;
  const double dy = y_m - origin.y_m;
  return {c * dx + s * dy, -s * dx + c * dy};
}

Eigen::Vector2d ColumnMap::map_from_plan(double u_m, double v_m) const {
  const double c = std::cos(origin.yaw_rad);
  const double s = std::sin(origin.yaw_rad);
  return {origin.x_m + c * u_m - s * v_m, origin.y_m + s * u_m + c * v_m};
}

std::optional<PixelIndex> ColumnMap::pixel_at(double x_m, double y_m) const {
  const Eigen::Vector2d plan = plan_from_map(x_m, y_m);
  const double column = std::floor(plan.x() / resolution_m + kEdgeSlack_px);
  const double up = std::floor(plan.y() / resolution_m + kEdgeSlack_px);
  if (!(column >= 0.0 && column < columns() && up >= 0.0 && up < rows())) return std::nullopt;
  return PixelIndex{rows() - 1 - static_cast<int>(up), static_cast<int>(column)};
}

const ColumnProfile* ColumnMap::at(double x_m, double y_m) const {
  const std::optional<PixelIndex> pixel = pixel_at(x_m, y_m);
  return pixel ? &profile(pixel->row, pixel->column) : nullptr;
}

Eigen::Vector2d ColumnMap::pixel_center(const PixelIndex& pixel) const {
  return map_from_plan((pixel.column + 0.5) * resolution_m,
                       (rows() - 1 - pixel.row + 0.5) * resolution_m);
}

Bounds ColumnMap::bounds() const {
  Bounds bounds{origin.x_m, origin.y_m, origin.x_m, origin.y_m};
  const double width_m = columns() * resolution_m;
  const double height_m = rows() * resolution_m;
  for (const auto& [u_m, v_m] : {std::pair{width_m, 0.0}, {0.0, height_m}, {width_m, height_m}}) {
    const Eigen::Vector2d corner = map_from_plan(u_m, v_m);
    bounds.min_x_m = std::min(bounds.min_x_m, corner.x());
    bounds.min_y_m = std::min(bounds.min_y_m, corner.y());
    bounds.max_x_m = std::max(bounds.max_x_m, corner.x());
    bounds.max_y_m = std::max(bounds.max_y_m, corner.y());
  }
  return bounds;
}

}  // namespace semview::map
