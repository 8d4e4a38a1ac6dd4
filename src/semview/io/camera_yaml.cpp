// SPDX-License-Identifier: Apache-2.0
#include "semview/io/camera_yaml.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "semview/geometry/angle.hpp"
#include "semview/io/png.hpp"

namespace semview::io {
namespace {

/// Axes of a camera that looks along x with z up, from those of the optical frame.
Eigen::Matrix3d level_from_optical() {
  Eigen::Matrix3d rotation;
  rotation << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return rotation;
}

}  // namespace

Eigen::Isometry3d base_from_level(const CameraMount& mount) {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.translation() = mount.position_m;
  transform.linear() = (Eigen::AngleAxisd(mount.yaw_rad, Eigen::Vector3d::UnitZ()) *
                        Eigen::AngleAxisd(mount.pitch_rad, Eigen::Vector3d::UnitY()) *
                        Eigen::AngleAxisd(mount.roll_rad, Eigen::Vector3d::UnitX()))
                           .toRotationMatrix();
  return transform;
}

Eigen::Isometry3d base_from_optical(const CameraMount& mount) {
  Eigen::Isometry3d transform = base_from_level(mount);
  transform.linear() = transform.linear() * level_from_optical();
  return transform;
}

CameraMount mount_of(const Eigen::Isometry3d& base_from_camera) {
  const Eigen::Matrix3d r = base_from_camera.linear() * level_from_optical().transpose();
  return {base_from_camera.translation(),
          std::atan2(r(2, 1), r(2, 2)),
          std::asin(std::clamp(-r(2, 0), -1.0, 1.0)),
          std::atan2(r(1, 0), r(0, 0))};
}

Result<CameraMount> parse_mount(const YamlNode& owner) {
  CameraMount mount;
  const std::optional<YamlNode> node = owner.find("base_from_camera");
  if (!node) return mount;
  SEMVIEW_TRY_STATUS(node->expect_keys({"x", "y", "z", "roll_deg", "pitch_deg", "yaw_deg"}));
  SEMVIEW_TRY(mount.position_m.x(), node->number_or("x", 0.0));
  SEMVIEW_TRY(mount.position_m.y(), node->number_or("y", 0.0));
  SEMVIEW_TRY(mount.position_m.z(), node->number_or("z", mount.position_m.z()));
  SEMVIEW_TRY(const double roll_deg, node->number_or("roll_deg", 0.0));
  SEMVIEW_TRY(const double pitch_deg, node->number_or("pitch_deg", 0.0));
  SEMVIEW_TRY(const double yaw_deg, node->number_or("yaw_deg", 0.0));
  mount.roll_rad = rad_from_deg(roll_deg);
  mount.pitch_rad = rad_from_deg(pitch_deg);
  mount.yaw_rad = rad_from_deg(yaw_deg);
  return mount;
}

Result<PartialPanorama> parse_panorama(const YamlNode& node) {
  SEMVIEW_TRY_STATUS(node.expect_keys(
      {"azimuth_left_deg", "azimuth_right_deg", "elevation_min_deg", "elevation_max_deg"}));
  SEMVIEW_TRY(const double left_deg, node.number_or("azimuth_left_deg", 180.0));
  SEMVIEW_TRY(const double right_deg, node.number_or("azimuth_right_deg", -180.0));
  SEMVIEW_TRY(const YamlNode lowest, node.at("elevation_min_deg"));
  SEMVIEW_TRY(const double lowest_deg, lowest.number());
  SEMVIEW_TRY(const YamlNode highest, node.at("elevation_max_deg"));
  SEMVIEW_TRY(const double highest_deg, highest.number());
  PartialPanorama camera;
  camera.azimuth_left_rad = rad_from_deg(left_deg);
  camera.azimuth_right_rad = rad_from_deg(right_deg);
  camera.elevation_min_rad = rad_from_deg(lowest_deg);
  camera.elevation_max_rad = rad_from_deg(highest_deg);
  // Its size comes with the image.
  PartialPanorama sized = camera;
  sized.rows = sized.columns = 1;
  if (const Status valid = validate(sized); !valid) return node.error(valid.error().message);
  return camera;
}

namespace {

/// Refuses a picture of less than 0.06 degrees, or of nearly the half space before the camera.
Status check_focal_length(const YamlNode& node,
                          std::string_view key,
                          double focal_px,
                          int side_px) {
  const double least_px = side_px / 100.0;
  const double most_px = side_px * 1000.0;
  if (focal_px >= least_px && focal_px <= most_px) return {};
  return node.error(fmt::format("{} {:g} px gives {} px no field of view, expected {:g} to {:g}",
                                key,
                                focal_px,
                                side_px,
                                least_px,
                                most_px));
}

}  // namespace

Result<PinholeCamera> parse_pinhole(const YamlNode& node) {
  SEMVIEW_TRY_STATUS(node.expect_keys({"width", "height", "fx", "fy", "cx", "cy"}));
  MountedPinhole mounted;
  const auto side = [&node](std::string_view key) -> Result<int> {
    SEMVIEW_TRY(const YamlNode value, node.at(key));
    SEMVIEW_TRY(const std::int64_t pixels, value.integer());
    if (pixels < 1 || pixels > kMaxPngSide_px) {
      return value.error(fmt::format("{} {}, expected 1 to {}", key, pixels, kMaxPngSide_px));
    }
    return static_cast<int>(pixels);
  };
  const auto number = [&node](std::string_view key) -> Result<double> {
    SEMVIEW_TRY(const YamlNode value, node.at(key));
    return value.number();
  };
  PinholeCamera& camera = mounted.camera;
  SEMVIEW_TRY(camera.columns, side("width"));
  SEMVIEW_TRY(camera.rows, side("height"));
  SEMVIEW_TRY(camera.fx_px, number("fx"));
  SEMVIEW_TRY(camera.fy_px, number("fy"));
  SEMVIEW_TRY(camera.cx_px, number("cx"));
  SEMVIEW_TRY(camera.cy_px, number("cy"));
  if (const Status valid = validate(mounted); !valid) return node.error(valid.error().message);
  SEMVIEW_TRY_STATUS(check_focal_length(node, "fx", camera.fx_px, camera.columns));
  SEMVIEW_TRY_STATUS(check_focal_length(node, "fy", camera.fy_px, camera.rows));
  return camera;
}

}  // namespace semview::io
