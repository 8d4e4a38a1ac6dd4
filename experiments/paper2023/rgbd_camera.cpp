// SPDX-License-Identifier: Apache-2.0
#include "rgbd_camera.hpp"

#include <algorithm>
#include <cmath>

namespace semview::paper2023 {
namespace {

using paper2017::Primitive;

/// Outward, of the solid's surface nearest to a point on it.
Eigen::Vector3d normal_at(const Primitive& solid, const Eigen::Vector3d& point) {
  const Eigen::AngleAxisd turn(solid.yaw_rad, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d local =
      turn.inverse() * (point - Eigen::Vector3d(solid.x_m, solid.y_m, 0.0));
  const double middle_z_m = (solid.z_min_m + solid.z_max_m) / 2.0;
  const double off_lid_m = (solid.z_max_m - solid.z_min_m) / 2.0 - std::abs(local.z() - middle_z_m);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ() * (local.z() < middle_z_m ? -1.0 : 1.0);
  if (solid.shape == paper2017::Shape::kCylinder) {
    const Eigen::Vector3d outward(local.x(), local.y(), 0.0);
    return std::abs(solid.half_length_m - outward.norm()) < std::abs(off_lid_m)
               ? turn * outward.normalized()
               : up;
  }
  const double off_x_m = std::abs(solid.half_length_m - std::abs(local.x()));
  const double off_y_m = std::abs(solid.half_width_m - std::abs(local.y()));
  if (std::abs(off_lid_m) <= std::min(off_x_m, off_y_m)) return up;
  return turn * (off_x_m <= off_y_m ? Eigen::Vector3d(std::copysign(1.0, local.x()), 0.0, 0.0)
                                    : Eigen::Vector3d(0.0, std::copysign(1.0, local.y()), 0.0));
}

}  // namespace

PinholeCamera pinhole(const RgbdConfig& config) {
  PinholeCamera camera;
  camera.columns = config.columns;
  camera.rows = config.rows;
  camera.cx_px = config.columns / 2.0;
  camera.cy_px = config.rows / 2.0;
  camera.fx_px = camera.cx_px / std::tan(config.width_rad / 2.0);
  camera.fy_px = camera.cy_px / std::tan(config.height_rad / 2.0);
  return camera;
}

Eigen::Isometry3d base_from_camera(const RgbdConfig& config) {
  Eigen::Matrix3d level;  // optical axes x right, y down, z forward
  level << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  Eigen::Isometry3d mounted = Eigen::Isometry3d::Identity();
  mounted.linear() =
      Eigen::AngleAxisd(config.mount_pitch_rad, Eigen::Vector3d::UnitY()).toRotationMatrix() *
      level;
  mounted.translation() = Eigen::Vector3d(0.0, 0.0, config.mount_height_m);
  return mounted;
}

Eigen::Isometry3d map_from_base(const Pose2& pose) {
  Eigen::Isometry3d placed = Eigen::Isometry3d::Identity();
  placed.linear() = Eigen::AngleAxisd(pose.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  placed.translation() = Eigen::Vector3d(pose.x_m, pose.y_m, 0.0);
  return placed;
}

double depth_sigma_m(const RgbdConfig& config, double z_m) {
  const double beyond_m = z_m - 0.4;
  return config.noise_m + config.noise_growth_per_m * beyond_m * beyond_m;
}

double dropout_share(const RgbdConfig& config, double incidence_rad) {
  return std::clamp(
      (incidence_rad - config.grazing_from_rad) / (config.grazing_to_rad - config.grazing_from_rad),
      0.0,
      1.0);
}

RgbdTruth look(const paper2017::Scene& scene,
               const RgbdConfig& config,
               const Eigen::Isometry3d& map_from_camera) {
  const PinholeCamera camera = pinhole(config);
  RgbdTruth truth{Image<float>(camera.rows, camera.columns),
                  Image<float>(camera.rows, camera.columns),
                  LabelImage(camera.rows, camera.columns, kNoHit),
                  Image<std::int32_t>(camera.rows, camera.columns, -1)};
  const Eigen::Vector3d eye = map_from_camera.translation();
  for (int row = 0; row < camera.rows; ++row) {
    for (int column = 0; column < camera.columns; ++column) {
      const Eigen::Vector3d ray = camera.direction(row, column);
      const Eigen::Vector3d along = map_from_camera.linear() * ray.normalized();
      const paper2017::SceneHit hit = scene.cast(eye, along);
      if (hit.object < 0) continue;
      const Eigen::Vector3d normal =
          normal_at(scene.primitives()[hit.solid], eye + hit.range_m * along);
      truth.depth_m.at(row, column) = static_cast<float>(hit.range_m / ray.norm());
      truth.incidence_rad.at(row, column) =
          static_cast<float>(std::acos(std::min(1.0, std::abs(normal.dot(along)))));
      truth.labels.at(row, column) = hit.label;
      truth.objects.at(row, column) = hit.object;
    }
  }
  return truth;
}

Image<float> measure(const RgbdTruth& truth, const RgbdConfig& config, Rng& rng) {
  Image<float> depth_m(truth.depth_m.rows(), truth.depth_m.columns());
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    const double true_m = truth.depth_m.pixels()[i];
    // Drawn for every pixel, so that one that changes leaves the others' noise alone.
    const double noise = rng.normal(0.0, 1.0);
    const double luck = rng.uniform();
    if (!(true_m > 0.0)) continue;
    if (luck < dropout_share(config, truth.incidence_rad.pixels()[i])) continue;
    const double z_m = true_m + noise * depth_sigma_m(config, true_m);
    if (z_m < config.min_depth_m || z_m > config.max_depth_m) continue;
    depth_m.pixels()[i] = static_cast<float>(std::round(z_m * 1000.0)) / 1000.0F;
  }
  return depth_m;
}

}  // namespace semview::paper2023
