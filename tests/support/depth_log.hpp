// SPDX-License-Identifier: Apache-2.0
/// The log of a depth camera on a robot that drives through a mesh, casts being exact.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "semview/io/png.hpp"
#include "semview/io/run_log.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/pinhole_renderer.hpp"

namespace semview::testing {

/// Level, 0.1 m ahead of the robot's centre and 0.9 m above the floor.
inline MountedPinhole robots_depth_camera() {
  MountedPinhole mounted;
  mounted.camera = {64, 48, 52.0, 52.0, 32.0, 24.0};
  mounted.base_from_camera = level_camera({0.1, 0.0, 0.0}, 0.9);
  return mounted;
}

/// Depth in whole millimetres; 0 beyond what 16 bits hold.
inline Image<std::uint16_t> depth_image(const RangeImage& depths_m) {
  Image<std::uint16_t> image(depths_m.rows(), depths_m.columns());
  for (std::size_t i = 0; i < image.pixels().size(); ++i) {
    const double depth_mm = std::round(1000.0 * double{depths_m.pixels()[i]});
    image.pixels()[i] = depth_mm < 65536.0 ? static_cast<std::uint16_t>(depth_mm) : 0;
  }
  return image;
}

/// Writes to `directory` what a depth camera sees in the mesh map `world` on the drive of `driven`,
/// a run log with ground truth; its odometry is that of the drive.
inline void record_depth_log(const io::RunLog& driven,
                             const std::filesystem::path& world,
                             const std::filesystem::path& directory) {
  const auto map = map::load_map(world);
  ASSERT_TRUE(map) << map.error().message;
  const auto scene = raycast::Scene::build(*map);
  ASSERT_TRUE(scene) << scene.error().message;
  const MountedPinhole mounted = robots_depth_camera();
  auto log = io::RunLogWriter::create(directory, {map->classes, mounted});
  ASSERT_TRUE(log) << log.error().message;
  for (const char* folder : {"depth", "labels"}) {
    std::filesystem::create_directories(directory / folder);
  }
  for (std::size_t i = 0; i < driven.frames.size(); ++i) {
    const double stamp_s = driven.frames[i].stamp_s;
    const Pose2 truth = *io::interpolate(*driven.groundtruth, stamp_s);
    Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
    map_from_base.translate(Eigen::Vector3d(truth.x_m, truth.y_m, map->ground_height_m));
    map_from_base.rotate(Eigen::AngleAxisd(truth.yaw_rad, Eigen::Vector3d::UnitZ()));
    const raycast::PinholeView view =
        raycast::render_pinhole(*scene, {map_from_base * mounted.base_from_camera, mounted.camera});
    const std::string file = fmt::format("{:06}.png", i);
    ASSERT_TRUE(io::write_png(directory / "depth" / file, depth_image(view.depths_m)));
    ASSERT_TRUE(io::write_png(directory / "labels" / file, view.labels));
    ASSERT_TRUE(log->add_files({stamp_s, "labels/" + file, "depth/" + file, {}}));
  }
  ASSERT_TRUE(log->finish(driven.odometry, *driven.groundtruth));
}

}  // namespace semview::testing
