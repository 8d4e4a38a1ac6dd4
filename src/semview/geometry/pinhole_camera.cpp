// SPDX-License-Identifier: Apache-2.0
#include "semview/geometry/pinhole_camera.hpp"

namespace semview {

Eigen::Isometry3d level_camera(const Pose2& map_from_robot, double eye_z_m) {
  const double c = std::cos(map_from_robot.yaw_rad);
  const double s = std::sin(map_from_robot.yaw_rad);
  Eigen::Matrix3d rotation;
  rotation.col(0) << s, -c, 0.0;      // x of the camera: right
  rotation.col(1) << 0.0, 0.0, -1.0;  // y: down
  rotation.col(2) << c, s, 0.0;       // z: forward
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  map_from_camera.linear() = rotation;
  map_from_camera.translation() << map_from_robot.x_m, map_from_robot.y_m, eye_z_m;
  return map_from_camera;
}

}  // namespace semview
