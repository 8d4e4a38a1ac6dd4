// SPDX-License-Identifier: Apache-2.0
/// One world of the experiment: a floor, a robot's way through it, and what the robot recorded.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "label_noise.hpp"
#include "layout.hpp"
#include "scene.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/view/observation_resampler.hpp"

namespace semview::paper2017 {

inline constexpr int kStops = 14;

struct CameraConfig {
  double width_rad = rad_from_deg(268.0);  ///< seven pictures stitched, section IV-A
  double height_rad = rad_from_deg(76.0);
  double pixel_rad = rad_from_deg(1.0);
  double height_m = 1.20;
  double height_sigma_m = 0.02;               ///< what the map's user does not know of it
  double tilt_sigma_rad = rad_from_deg(0.5);  ///< of pitch and of roll
  double person_share = 0.35;                 ///< of the views that show one
};

struct OdometryConfig {
  double scale_sigma = 0.030;      ///< of one factor for a whole drive
  double drift_sigma_rad = 0.027;  ///< of the heading a step
};

struct WorldConfig {
  LayoutConfig layout;
  CameraConfig camera;
  OdometryConfig odometry;
  LabelNoiseConfig noise;
};

/// Every setting, a line each: equal configurations have equal texts.
std::string describe(const WorldConfig& config);

/// Seeds of what is random, so that one can be changed and the others kept.
struct WorldSeeds {
  std::uint64_t layout = 1;  ///< the floor, its plan, the robot's way
  std::uint64_t odometry = 1;
  std::uint64_t camera = 1;
  std::uint64_t segmentation = 1;

  /// All of them from one world seed.
  static WorldSeeds all(std::uint64_t seed) { return {seed, seed, seed, seed}; }
};

struct Stop {
  Pose2 map_from_robot;   ///< true, in the undistorted plan
  Pose2 odom_from_robot;  ///< odometry, from (0, 0, 0) at the first stop
  SceneView truth;        ///< what the camera would name without an error
  LabelImage labels;      ///< what it names: ids of `raw_classes()`
};

struct World {
  Layout layout;
  std::vector<Stop> stops;
  PartialPanorama camera;  ///< of all `labels`
};

/// Lab A, corridor, a small room, corridor, lab B, corridor: 14 stops.
/// Equal arguments give equal worlds on every machine.
World make_world(const WorldConfig& config, const WorldSeeds& seeds);

}  // namespace semview::paper2017
