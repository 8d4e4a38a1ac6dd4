// SPDX-License-Identifier: Apache-2.0
#include "recording.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace semview::paper2023 {
namespace {

/// Seeds of different drives of one flat must differ, and those of drives of different flats.
std::uint64_t drive_seed(std::uint64_t world, std::string_view kind, int path) {
  return Rng(world, kind, static_cast<std::uint64_t>(path)).next_u64();
}

Eigen::Isometry3d noisy(const Eigen::Isometry3d& pose,
                        double position_m,
                        double angle_rad,
                        Rng& rng) {
  Eigen::Vector3d shift;
  Eigen::Vector3d turn;
  for (double& value : shift) value = rng.normal(0.0, position_m);
  for (double& value : turn) value = rng.normal(0.0, angle_rad);
  Eigen::Isometry3d off = pose;
  off.translation() += shift;
  const double turned_rad = turn.norm();
  if (turned_rad > 0.0) {
    off.linear() =
        pose.linear() * Eigen::AngleAxisd(turned_rad, turn / turned_rad).toRotationMatrix();
  }
  return off;
}

/// The slow part of a mapper's errors, frame by frame: a first-order autoregression.
std::vector<Pose2> slow_errors(const PoseNoiseConfig& config,
                               std::size_t frames,
                               std::uint64_t seed) {
  Rng rng(seed, "mapper's drift");
  const double kept = std::exp(-1.0 / config.slow_frames);
  const double fresh = std::sqrt(1.0 - kept * kept);
  const auto draw = [&] {
    const double x_m = rng.normal(0.0, config.slow_position_m);
    const double y_m = rng.normal(0.0, config.slow_position_m);
    return Pose2{x_m, y_m, rng.normal(0.0, config.slow_yaw_rad)};
  };
  std::vector<Pose2> errors;
  for (std::size_t i = 0; i < frames; ++i) {
    const Pose2 drawn = draw();
    if (i == 0) {
      errors.push_back(drawn);
      continue;
    }
    const Pose2& before = errors.back();
    errors.push_back({kept * before.x_m + fresh * drawn.x_m,
                      kept * before.y_m + fresh * drawn.y_m,
                      kept * before.yaw_rad + fresh * drawn.yaw_rad});
  }
  return errors;
}

/// A robot that is thought to be somewhere else, without its camera's turning about the origin.
Pose2 displaced(const Pose2& pose, const Pose2& error) {
  return {pose.x_m + error.x_m, pose.y_m + error.y_m, wrap_angle(pose.yaw_rad + error.yaw_rad)};
}

}  // namespace

bool measures_anything(const RecordedFrame& frame) {
  return std::ranges::any_of(frame.depth_m.pixels(), [](float z_m) { return z_m > 0.0F; });
}

std::string_view name(Session session) {
  return session == Session::kStatic ? "static" : "changed";
}

std::string describe(const WorldConfig& config) {
  const RgbdConfig& camera = config.camera;
  return fmt::format(
      "flat: {:g} x {:g} m, +-{:g}; ceiling {:g} m, doorways {:g} m; {:g} of the things are named\n"
      "changes: removed {:g}, moved {:g} by {:g} to {:g} m, added {:g}, renamed {:g}\n"
      "camera: {} x {} px, {:g} x {:g} deg, {:g} m high, {:g} deg down; {:g} to {:g} m; noise {:g} "
      "m + {:g} /m; grazing {:g} to {:g} deg\n"
      "detector: missed {:g}, mistaken {:g}, borders {:g} px of 640 over {:g} px\n"
      "drives: {:g} m; image after {:g} m or {:g} deg\n"
      "odometry: scale {:g}, drift {:g} rad, turns {:g}, slip {:g}\n"
      "mapper's poses: {:g} m, {:g} deg; over {:g} frames {:g} m, {:g} deg\n"
      "mount: {:g} m, {:g} deg\n",
      config.flat.width_m,
      config.flat.depth_m,
      config.flat.vary_m,
      config.flat.ceiling_m,
      config.flat.doorway_m,
      config.flat.named,
      config.change.removed,
      config.change.moved,
      config.change.min_move_m,
      config.change.max_move_m,
      config.change.added,
      config.change.renamed,
      camera.columns,
      camera.rows,
      deg_from_rad(camera.width_rad),
      deg_from_rad(camera.height_rad),
      camera.mount_height_m,
      deg_from_rad(camera.mount_pitch_rad),
      camera.min_depth_m,
      camera.max_depth_m,
      camera.noise_m,
      camera.noise_growth_per_m,
      deg_from_rad(camera.grazing_from_rad),
      deg_from_rad(camera.grazing_to_rad),
      config.detector.missed,
      config.detector.mistaken,
      config.detector.border_at_640_px,
      config.detector.wave_at_640_px,
      config.drive.length_m,
      config.drive.step_m,
      deg_from_rad(config.drive.turn_rad),
      config.odometry.scale_sigma,
      config.odometry.drift_rad_per_m,
      config.odometry.turn_sigma,
      config.odometry.slip_m_per_m,
      config.pose_noise.position_m,
      deg_from_rad(config.pose_noise.angle_rad),
      config.pose_noise.slow_frames,
      config.pose_noise.slow_position_m,
      deg_from_rad(config.pose_noise.slow_yaw_rad),
      config.mount_error.position_m,
      deg_from_rad(config.mount_error.angle_rad));
}

Recording record(const Flat& flat,
                 const std::vector<Pose2>& way,
                 const WorldConfig& config,
                 std::uint64_t always_seed,
                 const DriveSeeds& seeds,
                 ThreadPool& pool) {
  const paper2017::Scene scene = scene_of(flat);
  const std::vector<Pose2> odometry = odometry_of(way, config.odometry, seeds.odometry);
  Recording recording;
  recording.camera = pinhole(config.camera);
  recording.base_from_camera = base_from_camera(config.camera);
  Rng mount_rng(seeds.mount, "mount");
  const Eigen::Isometry3d mounted = noisy(recording.base_from_camera,
                                          config.mount_error.position_m,
                                          config.mount_error.angle_rad,
                                          mount_rng);
  const std::vector<Pose2> slow = slow_errors(config.pose_noise, way.size(), seeds.poses);
  recording.frames.resize(way.size());
  pool.parallel_for(way.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      RecordedFrame& frame = recording.frames[i];
      frame.map_from_base = way[i];
      frame.odom_from_base = odometry[i];
      const Eigen::Isometry3d camera = map_from_base(way[i]) * mounted;
      Rng pose_rng(seeds.poses, "mapper's poses", i);
      frame.map_from_camera = noisy(map_from_base(displaced(way[i], slow[i])) * mounted,
                                    config.pose_noise.position_m,
                                    config.pose_noise.angle_rad,
                                    pose_rng);
      const RgbdTruth truth = look(scene, config.camera, camera);
      Rng depth_rng(seeds.depth, "depth", i);
      frame.depth_m = measure(truth, config.camera, depth_rng);
      frame.labels_gt = true_labels(truth);
      const std::uint64_t view_seed = Rng(seeds.labels, "view", i).next_u64();
      frame.labels_rcnn = detect(truth, config.detector, always_seed, view_seed);
    }
  });
  return recording;
}

Recording record_survey(const WorldConfig& config, std::uint64_t world, ThreadPool& pool) {
  const Flat flat = draw_flat(config.flat, world);
  const std::uint64_t seed = drive_seed(world, "survey", 0);
  return record(
      flat, plan_survey(flat, config.drive, seed), config, world, DriveSeeds::all(seed), pool);
}

Recording record_path(
    const WorldConfig& config, std::uint64_t world, Session session, int path, ThreadPool& pool) {
  Flat flat = draw_flat(config.flat, world);
  const std::uint64_t seed = drive_seed(world, name(session), path);
  if (session == Session::kChanged) flat = change(flat, config.change, seed);
  return record(
      flat, plan_drive(flat, config.drive, seed), config, world, DriveSeeds::all(seed), pool);
}

}  // namespace semview::paper2023
