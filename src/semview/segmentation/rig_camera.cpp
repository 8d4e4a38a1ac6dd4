// SPDX-License-Identifier: Apache-2.0
#include "semview/segmentation/rig_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "semview/geometry/angle.hpp"

namespace semview::segmentation {
namespace {

constexpr double kFullTurn_rad = kTwoPi - 1.0e-6;

std::optional<Eigen::Vector2d> pixel_in(const LensCamera& camera,
                                        const Eigen::Vector3d& direction) {
  const PinholeCamera& pinhole = camera.pinhole;
  const std::optional<Eigen::Vector2d> point =
      camera.lens.project(camera.base_from_camera.linear().transpose() * direction);
  if (!point) return std::nullopt;
  const double u = pinhole.fx_px * point->x() + pinhole.cx_px;
  const double v = pinhole.fy_px * point->y() + pinhole.cy_px;
  if (!(u >= 0.0 && u < pinhole.columns && v >= 0.0 && v < pinhole.rows)) return std::nullopt;
  return Eigen::Vector2d(u, v);
}

std::optional<Eigen::Vector2d> pixel_in(const EquirectangularCamera& camera,
                                        const Eigen::Vector3d& direction) {
  const PartialPanorama& photo = camera.photo;
  const Eigen::Vector3d d = camera.base_from_camera.linear().transpose() * direction;
  double from_left = photo.azimuth_left_rad - std::atan2(d.y(), d.x());
  from_left -= kTwoPi * std::floor(from_left / kTwoPi);
  const double turn = photo.azimuth_left_rad - photo.azimuth_right_rad;
  const double from_top = photo.elevation_max_rad - std::atan2(d.z(), std::hypot(d.x(), d.y()));
  const double u = from_left / turn * photo.columns;
  const double v = from_top / (photo.elevation_max_rad - photo.elevation_min_rad) * photo.rows;
  if (!(u >= 0.0 && u < photo.columns && v >= 0.0 && v < photo.rows)) return std::nullopt;
  return Eigen::Vector2d(u, v);
}

double border_share(double at, int side) {
  return std::clamp(2.0 * std::min(at, side - at) / side, 0.0, 1.0);
}

}  // namespace

int rows_of(const RigCamera& camera) {
  const auto* lens = std::get_if<LensCamera>(&camera);
  return lens != nullptr ? lens->pinhole.rows : std::get<EquirectangularCamera>(camera).photo.rows;
}

int columns_of(const RigCamera& camera) {
  const auto* lens = std::get_if<LensCamera>(&camera);
  return lens != nullptr ? lens->pinhole.columns
                         : std::get<EquirectangularCamera>(camera).photo.columns;
}

const Eigen::Isometry3d& base_from(const RigCamera& camera) {
  const auto* lens = std::get_if<LensCamera>(&camera);
  return lens != nullptr ? lens->base_from_camera
                         : std::get<EquirectangularCamera>(camera).base_from_camera;
}

Result<RigCamera> of_size(const RigCamera& camera, int rows, int columns) {
  if (const auto* whole = std::get_if<EquirectangularCamera>(&camera)) {
    EquirectangularCamera sized = *whole;
    sized.photo.rows = rows;
    sized.photo.columns = columns;
    return RigCamera(sized);
  }
  if (rows_of(camera) != rows || columns_of(camera) != columns) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{} x {} pixels, expected the camera's {} x {}",
                            columns,
                            rows,
                            columns_of(camera),
                            rows_of(camera)));
  }
  return camera;
}

std::optional<Eigen::Vector2d> pixel_of(const RigCamera& camera, const Eigen::Vector3d& direction) {
  return std::visit([&](const auto& kind) { return pixel_in(kind, direction); }, camera);
}

double distance_to_border(const RigCamera& camera, const Eigen::Vector2d& pixel) {
  const int rows = rows_of(camera);
  const int columns = columns_of(camera);
  const auto* whole = std::get_if<EquirectangularCamera>(&camera);
  if (whole != nullptr &&
      whole->photo.azimuth_left_rad - whole->photo.azimuth_right_rad >= kFullTurn_rad) {
    return border_share(pixel.y(), rows);
  }
  const int shorter = std::min(rows, columns);
  const double nearest = std::min({pixel.x(), columns - pixel.x(), pixel.y(), rows - pixel.y()});
  return std::clamp(2.0 * nearest / shorter, 0.0, 1.0);
}

double widest_half_angle_rad(const RigCamera& camera) {
  const auto* lens = std::get_if<LensCamera>(&camera);
  if (lens == nullptr) return kPi;
  const PinholeCamera& pinhole = lens->pinhole;
  const double right = pinhole.columns;
  const double bottom = pinhole.rows;
  const std::array<Eigen::Vector2d, 4> edges{Eigen::Vector2d(0.0, pinhole.cy_px),
                                             Eigen::Vector2d(right, pinhole.cy_px),
                                             Eigen::Vector2d(pinhole.cx_px, 0.0),
                                             Eigen::Vector2d(pinhole.cx_px, bottom)};
  double widest_rad = 0.0;
  for (const Eigen::Vector2d& edge : edges) {
    const auto direction = lens->lens.unproject(
        {(edge.x() - pinhole.cx_px) / pinhole.fx_px, (edge.y() - pinhole.cy_px) / pinhole.fy_px});
    // Past what the lens shows at all: a fisheye's image circle lies inside its picture.
    if (!direction) return kPi;
    widest_rad = std::max(widest_rad,
                          std::atan2(std::hypot(direction->x(), direction->y()), direction->z()));
  }
  return widest_rad;
}

}  // namespace semview::segmentation
