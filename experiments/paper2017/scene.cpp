// SPDX-License-Identifier: Apache-2.0
#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "semview/geometry/angle.hpp"

namespace semview::paper2017 {
namespace {

constexpr double kSquare_m = 0.5;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// Where a ray is inside of something: from `enter` to `leave`, in ray parameters.
struct Stretch {
  double enter = -kNever;
  double leave = kNever;
};

void cut_by_slab(double origin, double direction, double low, double high, Stretch& stretch) {
  if (direction == 0.0) {
    if (origin < low || origin > high) stretch.enter = kNever;
    return;
  }
  double first = (low - origin) / direction;
  double second = (high - origin) / direction;
  if (first > second) std::swap(first, second);
  stretch.enter = std::max(stretch.enter, first);
  stretch.leave = std::min(stretch.leave, second);
}

void cut_by_cylinder(double x, double y, double dx, double dy, double radius, Stretch& stretch) {
  const double a = dx * dx + dy * dy;
  const double b = x * dx + y * dy;
  const double c = x * x + y * y - radius * radius;
  if (a == 0.0) {
    if (c > 0.0) stretch.enter = kNever;
    return;
  }
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0) {
    stretch.enter = kNever;
    return;
  }
  const double root = std::sqrt(discriminant);
  stretch.enter = std::max(stretch.enter, (-b - root) / a);
  stretch.leave = std::min(stretch.leave, (-b + root) / a);
}

/// The ray's first crossing of the solid's surface; none if it passes by.
std::optional<double> crossing(const Primitive& solid,
                               const Eigen::Vector3d& origin,
                               const Eigen::Vector3d& direction) {
  Stretch stretch;
  cut_by_slab(origin.z(), direction.z(), solid.z_min_m, solid.z_max_m, stretch);
  if (stretch.enter > stretch.leave) return std::nullopt;
  const double c = std::cos(solid.yaw_rad);
  const double s = std::sin(solid.yaw_rad);
  const double from_x = origin.x() - solid.x_m;
  const double from_y = origin.y() - solid.y_m;
  const double x = c * from_x + s * from_y;
  const double y = -s * from_x + c * from_y;
  const double dx = c * direction.x() + s * direction.y();
  const double dy = -s * direction.x() + c * direction.y();
  if (solid.shape == Shape::kCylinder) {
    cut_by_cylinder(x, y, dx, dy, solid.half_length_m, stretch);
  } else {
    cut_by_slab(x, dx, -solid.half_length_m, solid.half_length_m, stretch);
    cut_by_slab(y, dy, -solid.half_width_m, solid.half_width_m, stretch);
  }
  if (stretch.enter > stretch.leave || stretch.leave <= 0.0) return std::nullopt;
  return stretch.enter > 0.0 ? stretch.enter : stretch.leave;
}

double reach(const Primitive& solid) {
  return solid.shape == Shape::kCylinder ? solid.half_length_m
                                         : std::hypot(solid.half_length_m, solid.half_width_m);
}

/// The rectangle that holds a turned box, half its size.
std::pair<double, double> half_extent(const Primitive& solid) {
  if (solid.shape == Shape::kCylinder) return {solid.half_length_m, solid.half_length_m};
  const double c = std::abs(std::cos(solid.yaw_rad));
  const double s = std::abs(std::sin(solid.yaw_rad));
  return {c * solid.half_length_m + s * solid.half_width_m,
          s * solid.half_length_m + c * solid.half_width_m};
}

int square_of(double offset_m) { return static_cast<int>(std::floor(offset_m / kSquare_m)); }

}  // namespace

Scene::Scene(std::vector<Primitive> primitives) : primitives_(std::move(primitives)) {
  double max_x_m = -kNever;
  double max_y_m = -kNever;
  min_x_m_ = kNever;
  min_y_m_ = kNever;
  for (const Primitive& solid : primitives_) {
    const auto [dx, dy] = half_extent(solid);
    min_x_m_ = std::min(min_x_m_, solid.x_m - dx);
    min_y_m_ = std::min(min_y_m_, solid.y_m - dy);
    max_x_m = std::max(max_x_m, solid.x_m + dx);
    max_y_m = std::max(max_y_m, solid.y_m + dy);
  }
  if (primitives_.empty()) return;
  columns_ = square_of(max_x_m - min_x_m_) + 1;
  rows_ = square_of(max_y_m - min_y_m_) + 1;
  squares_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (std::size_t i = 0; i < primitives_.size(); ++i) {
    const Primitive& solid = primitives_[i];
    const auto [dx, dy] = half_extent(solid);
    const int last_row = std::min(rows_ - 1, square_of(solid.y_m + dy - min_y_m_));
    const int last_column = std::min(columns_ - 1, square_of(solid.x_m + dx - min_x_m_));
    for (int row = std::max(0, square_of(solid.y_m - dy - min_y_m_)); row <= last_row; ++row) {
      for (int column = std::max(0, square_of(solid.x_m - dx - min_x_m_)); column <= last_column;
           ++column) {
        squares_[static_cast<std::size_t>(row * columns_ + column)].push_back(
            static_cast<std::uint32_t>(i));
      }
    }
  }
}

const std::vector<std::uint32_t>& Scene::square(int column, int row) const {
  return squares_[static_cast<std::size_t>(row * columns_ + column)];
}

SceneHit Scene::cast(const Eigen::Vector3d& origin_m, const Eigen::Vector3d& direction) const {
  SceneHit hit;
  hit.range_m = kNever;
  if (primitives_.empty()) return hit;
  Stretch inside;
  cut_by_slab(origin_m.x(), direction.x(), min_x_m_, min_x_m_ + kSquare_m * columns_, inside);
  cut_by_slab(origin_m.y(), direction.y(), min_y_m_, min_y_m_ + kSquare_m * rows_, inside);
  if (inside.enter > inside.leave || inside.leave < 0.0 || inside.enter == kNever) return hit;
  // From square to square (Amanatides, Woo 1987) until the nearest hit lies before the next one.
  const double from = std::max(0.0, inside.enter);
  const auto first_square = [from](double origin, double along, double low, int count) {
    return std::clamp(square_of(origin + from * along - low), 0, count - 1);
  };
  int column = first_square(origin_m.x(), direction.x(), min_x_m_, columns_);
  int row = first_square(origin_m.y(), direction.y(), min_y_m_, rows_);
  const int step_x = direction.x() > 0.0 ? 1 : -1;
  const int step_y = direction.y() > 0.0 ? 1 : -1;
  const auto until = [](double origin, double along, double edge) {
    return along == 0.0 ? kNever : (edge - origin) / along;
  };
  double next_x =
      until(origin_m.x(), direction.x(), min_x_m_ + kSquare_m * (column + (step_x > 0 ? 1 : 0)));
  double next_y =
      until(origin_m.y(), direction.y(), min_y_m_ + kSquare_m * (row + (step_y > 0 ? 1 : 0)));
  const double stride_x = direction.x() == 0.0 ? kNever : kSquare_m / std::abs(direction.x());
  const double stride_y = direction.y() == 0.0 ? kNever : kSquare_m / std::abs(direction.y());
  while (column >= 0 && column < columns_ && row >= 0 && row < rows_) {
    for (const std::uint32_t index : square(column, row)) {
      const std::optional<double> range_m = crossing(primitives_[index], origin_m, direction);
      if (range_m && *range_m < hit.range_m) {
        hit = {primitives_[index].label, primitives_[index].object, *range_m, index};
      }
    }
    const double next = std::min(next_x, next_y);
    if (hit.range_m <= next || next == kNever) break;
    if (next_x <= next_y) {
      column += step_x;
      next_x += stride_x;
    } else {
      row += step_y;
      next_y += stride_y;
    }
  }
  return hit;
}

SceneView Scene::render(const SceneCamera& camera) const {
  const Eigen::Matrix3d world_from_camera =
      (Eigen::AngleAxisd(camera.yaw_rad, Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(camera.pitch_rad, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(camera.roll_rad, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  SceneView view{LabelImage(camera.rows, camera.columns, kNoHit),
                 Image<std::int32_t>(camera.rows, camera.columns, -1),
                 Image<float>(camera.rows, camera.columns, std::numeric_limits<float>::infinity())};
  for (int row = 0; row < camera.rows; ++row) {
    const double elevation_rad = (0.5 - (row + 0.5) / camera.rows) * camera.height_rad;
    for (int column = 0; column < camera.columns; ++column) {
      const double azimuth_rad = (0.5 - (column + 0.5) / camera.columns) * camera.width_rad;
      const Eigen::Vector3d direction =
          world_from_camera * Eigen::Vector3d(std::cos(elevation_rad) * std::cos(azimuth_rad),
                                              std::cos(elevation_rad) * std::sin(azimuth_rad),
                                              std::sin(elevation_rad));
      const SceneHit hit = cast(camera.position_m, direction);
      if (hit.object < 0) continue;
      view.labels.at(row, column) = hit.label;
      view.objects.at(row, column) = hit.object;
      view.ranges_m.at(row, column) = static_cast<float>(hit.range_m);
    }
  }
  return view;
}

bool Scene::blocked(double x_m, double y_m, double radius_m, double z_min_m, double z_max_m) const {
  return std::ranges::any_of(primitives_, [&](const Primitive& solid) {
    if (solid.z_max_m <= z_min_m || solid.z_min_m >= z_max_m) return false;
    const double from_x = x_m - solid.x_m;
    const double from_y = y_m - solid.y_m;
    if (std::hypot(from_x, from_y) > reach(solid) + radius_m) return false;
    if (solid.shape == Shape::kCylinder) return true;
    const double c = std::cos(solid.yaw_rad);
    const double s = std::sin(solid.yaw_rad);
    const double beyond_x = std::max(0.0, std::abs(c * from_x + s * from_y) - solid.half_length_m);
    const double beyond_y = std::max(0.0, std::abs(-s * from_x + c * from_y) - solid.half_width_m);
    return std::hypot(beyond_x, beyond_y) < radius_m;
  });
}

}  // namespace semview::paper2017
