// SPDX-License-Identifier: Apache-2.0
#include "semview/segmentation/crops.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "semview/geometry/angle.hpp"

namespace semview::segmentation {
namespace {

constexpr double kWidestHalfAngle_deg = 60.0;
constexpr int kMostSamples = 4;  ///< along each side of a crop's pixel

/// Photographs of a full turn go on at the other side.
int wrapped(int column, const Photo& photo) {
  const int columns = photo.image.columns();
  const bool turns = std::holds_alternative<EquirectangularCamera>(photo.camera);
  if (turns) return (column + columns) % columns;
  return std::clamp(column, 0, columns - 1);
}

Eigen::Vector3d colour_at(const Photo& photo, const Eigen::Vector2d& pixel) {
  const double x = pixel.x() - 0.5;
  const double y = pixel.y() - 0.5;
  const int left = static_cast<int>(std::floor(x));
  const int top = static_cast<int>(std::floor(y));
  const double right_share = x - left;
  const double bottom_share = y - top;
  const auto at = [&photo](int row, int column) {
    const Rgb& rgb =
        photo.image.at(std::clamp(row, 0, photo.image.rows() - 1), wrapped(column, photo));
    return Eigen::Vector3d(rgb.r, rgb.g, rgb.b);
  };
  const Eigen::Vector3d above =
      (1.0 - right_share) * at(top, left) + right_share * at(top, left + 1);
  const Eigen::Vector3d below =
      (1.0 - right_share) * at(top + 1, left) + right_share * at(top + 1, left + 1);
  return (1.0 - bottom_share) * above + bottom_share * below;
}

/// How many samples along each side of a pixel of `camera` miss no pixel of the photograph.
int samples_along(const Photo& photo, const LensCamera& camera) {
  const Eigen::Matrix3d base_from_camera = camera.base_from_camera.linear();
  const double step = 1.0 / camera.pinhole.fx_px;
  const auto a = pixel_of(photo.camera, base_from_camera * Eigen::Vector3d(0.0, 0.0, 1.0));
  const auto b = pixel_of(photo.camera, base_from_camera * Eigen::Vector3d(0.0, step, 1.0));
  if (!a || !b) return 1;
  return std::clamp(static_cast<int>(std::ceil((*a - *b).norm())), 1, kMostSamples);
}

unsigned char byte(double value) {
  return static_cast<unsigned char>(std::lround(std::clamp(value, 0.0, 255.0)));
}

LensCamera level_camera_at(double yaw_rad) {
  LensCamera camera;
  camera.pinhole.rows = camera.pinhole.columns = kCropSide_px;
  camera.pinhole.cx_px = camera.pinhole.cy_px = kCropSide_px / 2.0;
  camera.pinhole.fx_px = camera.pinhole.fy_px =
      kCropSide_px / 2.0 / std::tan(rad_from_deg(kCropWidth_deg / 2.0));
  camera.base_from_camera = level_camera({0.0, 0.0, yaw_rad}, 0.0);
  return camera;
}

}  // namespace

bool is_too_wide(const RigCamera& camera) {
  return widest_half_angle_rad(camera) > rad_from_deg(kWidestHalfAngle_deg);
}

Crop crop(const Photo& photo, const LensCamera& camera) {
  const int rows = camera.pinhole.rows;
  const int columns = camera.pinhole.columns;
  const int samples = samples_along(photo, camera);
  Crop result{{camera, RgbImage(rows, columns)}, Image<std::uint8_t>(rows, columns, 0)};
  const Eigen::Matrix3d base_from_camera = camera.base_from_camera.linear();
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      int seen = 0;
      for (int i = 0; i < samples * samples; ++i) {
        const double u = c + (i % samples + 0.5) / samples;
        const double v = r + (i / samples + 0.5) / samples;
        const Eigen::Vector3d ray((u - camera.pinhole.cx_px) / camera.pinhole.fx_px,
                                  (v - camera.pinhole.cy_px) / camera.pinhole.fy_px,
                                  1.0);
        const std::optional<Eigen::Vector2d> pixel = pixel_of(photo.camera, base_from_camera * ray);
        if (!pixel) continue;
        sum += colour_at(photo, *pixel);
        ++seen;
      }
      if (seen == 0) continue;
      sum /= seen;
      result.photo.image.at(r, c) = {byte(sum.x()), byte(sum.y()), byte(sum.z())};
      result.seen.at(r, c) = 255;
    }
  }
  return result;
}

std::vector<Crop> level_crops(const Photo& photo) {
  std::vector<Crop> crops;
  for (int k = 0; k < kCrops; ++k) {
    Crop next = crop(photo, level_camera_at(wrap_angle(k * kTwoPi / kCrops)));
    const bool shows =
        std::ranges::any_of(next.seen.pixels(), [](std::uint8_t s) { return s > 0; });
    if (shows) crops.push_back(std::move(next));
  }
  return crops;
}

}  // namespace semview::segmentation
