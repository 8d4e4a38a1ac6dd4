// SPDX-License-Identifier: Apache-2.0
/// The robot's depth camera: what it sees exactly, and what it measures of that.
#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "experiments/paper2017/scene.hpp"
#include "semview/core/random.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/geometry/image.hpp"
#include "semview/geometry/pinhole_camera.hpp"
#include "semview/geometry/pose2.hpp"

namespace semview::paper2023 {

struct RgbdConfig {
  int columns = 160;  ///< a quarter of a real camera's 640, for speed
  int rows = 120;
  double width_rad = rad_from_deg(58.0);
  double height_rad = rad_from_deg(45.0);
  double mount_height_m = 1.0;
  double mount_pitch_rad = rad_from_deg(12.0);  ///< looks down
  double min_depth_m = 0.4;
  double max_depth_m = 4.5;
  double noise_m = 0.0012;  ///< σ of depth z is noise + growth·(z - 0.4 m)²
  double noise_growth_per_m = 0.0019;
  /// Nothing comes back of surfaces seen more obliquely than the second angle from their normal,
  /// and of a growing share from the first one on.
  double grazing_from_rad = rad_from_deg(75.0);
  double grazing_to_rad = rad_from_deg(85.0);
};

PinholeCamera pinhole(const RgbdConfig& config);
Eigen::Isometry3d base_from_camera(const RgbdConfig& config);
Eigen::Isometry3d map_from_base(const Pose2& pose);

/// σ of a measurement of depth `z_m`.
double depth_sigma_m(const RgbdConfig& config, double z_m);
/// Share of the pixels on a surface at this angle from its normal that measure nothing.
double dropout_share(const RgbdConfig& config, double incidence_rad);

/// What each pixel truly shows.
struct RgbdTruth {
  Image<float> depth_m;         ///< 0: nothing there
  Image<float> incidence_rad;   ///< of the ray to the surface's normal
  LabelImage labels;            ///< `kNoHit` of walls, floor and ceiling
  Image<std::int32_t> objects;  ///< 0 of walls, floor and ceiling; -1: nothing there
};
RgbdTruth look(const paper2017::Scene& scene,
               const RgbdConfig& config,
               const Eigen::Isometry3d& map_from_camera);

/// The depth that the camera gives, in whole millimetres; 0: not measured.
Image<float> measure(const RgbdTruth& truth, const RgbdConfig& config, Rng& rng);

}  // namespace semview::paper2023
