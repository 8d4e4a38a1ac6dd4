// SPDX-License-Identifier: Apache-2.0
/// What a robot records on one drive through a flat.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "detections.hpp"
#include "drive.hpp"
#include "rgbd_camera.hpp"
#include "semview/core/thread_pool.hpp"
#include "session.hpp"

namespace semview::paper2023 {

/// Of the poses that a map is made with.
struct PoseNoiseConfig {
  double position_m = 0.01;              ///< σ of each coordinate
  double angle_rad = rad_from_deg(0.3);  ///< σ about each axis
  /// σ of what stays about the same for `slow_frames` frames, as a mapper's drift between closed
  /// loops does: along the ground, and about the vertical.
  double slow_position_m = 0.17;
  double slow_yaw_rad = rad_from_deg(4.0);
  double slow_frames = 40.0;
};

/// How far the camera is from where it is said to be mounted: drawn once a drive.
struct MountErrorConfig {
  double position_m = 0.05;              ///< σ of each coordinate
  double angle_rad = rad_from_deg(2.0);  ///< σ about each axis
};

struct WorldConfig {
  FlatConfig flat;
  ChangeConfig change;
  RgbdConfig camera;
  DetectorConfig detector;
  DriveConfig drive;
  OdometryConfig odometry;
  PoseNoiseConfig pose_noise;
  MountErrorConfig mount_error;
};

/// Every setting, a line each part: equal configurations have equal texts.
std::string describe(const WorldConfig& config);

/// Seeds of what is random in a drive, so that one can be changed and the others kept.
struct DriveSeeds {
  std::uint64_t way = 1;
  std::uint64_t odometry = 1;
  std::uint64_t depth = 1;
  std::uint64_t labels = 1;  ///< of single views
  std::uint64_t poses = 1;
  std::uint64_t mount = 1;

  static DriveSeeds all(std::uint64_t seed) { return {seed, seed, seed, seed, seed, seed}; }
};

struct RecordedFrame {
  Pose2 map_from_base;                ///< true
  Pose2 odom_from_base;               ///< from (0, 0, 0) at the first frame
  Eigen::Isometry3d map_from_camera;  ///< as a mapper knows it, with noise; optical frame
  Image<float> depth_m;
  LabelImage labels_gt;
  LabelImage labels_rcnn;
};

/// Whether any pixel has a depth.
bool measures_anything(const RecordedFrame& frame);

struct Recording {
  PinholeCamera camera;
  Eigen::Isometry3d base_from_camera = Eigen::Isometry3d::Identity();  ///< as it is said to be
  std::vector<RecordedFrame> frames;
};

/// Drives the poses through what stands in the flat. The same frames for any number of threads.
/// @param always_seed  of what a detector always gets wrong: of the flat, not of the drive
Recording record(const Flat& flat,
                 const std::vector<Pose2>& way,
                 const WorldConfig& config,
                 std::uint64_t always_seed,
                 const DriveSeeds& seeds,
                 ThreadPool& pool);

enum class Session {
  kStatic,   ///< as mapped
  kChanged,  ///< things removed, moved, added, renamed
};

/// "static" or "changed".
std::string_view name(Session session);

/// The drive of a flat's survey, which maps are made of.
Recording record_survey(const WorldConfig& config, std::uint64_t world, ThreadPool& pool);

/// A drive to localize on. Each path of the changed session sees changes of its own.
Recording record_path(
    const WorldConfig& config, std::uint64_t world, Session session, int path, ThreadPool& pool);

}  // namespace semview::paper2023
