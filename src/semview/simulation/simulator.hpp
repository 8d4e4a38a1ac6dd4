// SPDX-License-Identifier: Apache-2.0
/// A synthetic robot: drives through a building and writes the run log that a real one would.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "semview/core/result.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/simulation/odometry_noise.hpp"
#include "semview/simulation/path_planner.hpp"
#include "semview/simulation/robot_drive.hpp"
#include "semview/simulation/segmentation_noise.hpp"
#include "semview/simulation/world.hpp"

namespace semview::simulation {

struct CameraConfig {
  int columns = 720;  ///< of a full turn; finer than the map's views, so that pixels do not align
  int rows = 180;
  double azimuth_width_rad = kTwoPi;  ///< in (0, 2π], half of it on either side of the heading
  double elevation_min_rad = -kPi / 4.0;
  double elevation_max_rad = kPi / 4.0;
  double height_m = 1.2;  ///< above the ground, as the robot believes
  double height_error_m =
      0.02;  ///< how far off that is at most, some of it changing with each frame
};

struct SimulationConfig {
  std::uint64_t seed = 1;
  int frames = 30;                ///< >= 1
  double frame_distance_m = 0.5;  ///< way between two frames; > 0
  /// Scales every error: odometry, labels, camera height, object heights and missing furniture; in
  /// [0, 5]. 0: a perfect robot in a building that is as drawn.
  double noise_level = 1.0;
  CameraConfig camera;
  WorldConfig world;
  TourConfig tour;  ///< its length is that of the frames
  DriveConfig drive;
  OdometryNoiseConfig odometry;
  SegmentationNoiseConfig segmentation;
  std::string engine = "auto";  ///< what casts the frames: "auto", "columns" or "embree"
};

/// What a run was like; for people and scripts.
struct SimulationReport {
  int frames = 0;
  double way_m = 0.0;
  double duration_s = 0.0;
  Pose2 start;                     ///< true pose at the first frame
  double odometry_error_m = 0.0;   ///< at the end, odometry laid onto the true start
  double wrong_label_share = 0.0;  ///< of the labelled pixels
  double min_clearance_m = 0.0;    ///< to the nearest obstacle, within 10 cm
  int objects = 0;
  int furniture = 0;
  int missing = 0;
  int opened_doors = 0;
  std::string engine;
  std::string engine_reason;
};

/// @errors kInvalidArgument: a value out of its range; `Error::field` names it.
Status validate(const SimulationConfig& config);

/// Drives through `world` and writes odometry, label images and ground truth to `directory`.
///
/// The world's layout, the way, odometry, camera and labels take separate random streams of the
/// seed: a change of one leaves the others as they are. The same arguments give the same files.
/// Doors that the robot goes through stand open.
///
/// @param world  drawn or meshed; a drawn one is varied as `config.world` says. Its classes are
///               those of the observations.
/// @errors kFailedPrecondition: no room to drive; those of `io::RunLogWriter`.
Result<SimulationReport> simulate(const map::SemanticMap& world,
                                  const SimulationConfig& config,
                                  const std::filesystem::path& directory);

}  // namespace semview::simulation
