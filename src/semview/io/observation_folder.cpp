// SPDX-License-Identifier: Apache-2.0
#include "semview/io/observation_folder.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "semview/io/png.hpp"
#include "semview/io/text_file.hpp"

namespace semview::io {
namespace {

constexpr int kFormat = 1;

struct Mount {
  Eigen::Vector3d position_m = {0.0, 0.0, 1.2};
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;
};

/// Axes of a camera that looks along x with z up, from those of the optical frame.
Eigen::Matrix3d level_from_optical() {
  Eigen::Matrix3d rotation;
  rotation << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return rotation;
}

Eigen::Isometry3d base_from_optical(const Mount& mount) {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.translation() = mount.position_m;
  transform.linear() = (Eigen::AngleAxisd(mount.yaw_rad, Eigen::Vector3d::UnitZ()) *
                        Eigen::AngleAxisd(mount.pitch_rad, Eigen::Vector3d::UnitY()) *
                        Eigen::AngleAxisd(mount.roll_rad, Eigen::Vector3d::UnitX()))
                           .toRotationMatrix() *
                       level_from_optical();
  return transform;
}

Mount mount_of(const Eigen::Isometry3d& base_from_camera) {
  const Eigen::Matrix3d r = base_from_camera.linear() * level_from_optical().transpose();
  return {base_from_camera.translation(),
          std::atan2(r(2, 1), r(2, 2)),
          std::asin(std::clamp(-r(2, 0), -1.0, 1.0)),
          std::atan2(r(1, 0), r(0, 0))};
}

Result<ClassTable> parse_classes(const YamlNode& node) {
  SEMVIEW_TRY(std::vector<std::string> names, node.texts());
  if (names.empty() || names.size() > kMaxClasses) {
    return node.error(fmt::format("{} classes, expected 1 to {}", names.size(), kMaxClasses));
  }
  std::set<std::string> seen;
  for (const YamlNode& item : node.items()) {
    SEMVIEW_TRY(const std::string name, item.text());
    if (name.empty()) return item.error("a class without a name");
    if (!seen.insert(name).second) return item.error(fmt::format("class '{}' twice", name));
  }
  return ClassTable(std::move(names));
}

Result<Mount> parse_mount(const YamlNode& document) {
  Mount mount;
  const std::optional<YamlNode> node = document.find("base_from_camera");
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

Result<PartialPanorama> parse_panorama(const YamlNode& node, const Mount& mount) {
  SEMVIEW_TRY_STATUS(node.expect_keys(
      {"azimuth_left_deg", "azimuth_right_deg", "elevation_min_deg", "elevation_max_deg"}));
  if (mount.roll_rad != 0.0 || mount.pitch_rad != 0.0 || mount.yaw_rad != 0.0) {
    return node.error(
        "a panorama's azimuths are counted from the robot's heading: roll, pitch and yaw of "
        "base_from_camera must be 0");
  }
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
  camera.position_m = mount.position_m;
  // Its size comes with the image.
  PartialPanorama sized = camera;
  sized.rows = sized.columns = 1;
  if (const Status valid = validate(sized); !valid) return node.error(valid.error().message);
  return camera;
}

Result<MountedPinhole> parse_pinhole(const YamlNode& node, const Mount& mount) {
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
  SEMVIEW_TRY(mounted.camera.columns, side("width"));
  SEMVIEW_TRY(mounted.camera.rows, side("height"));
  SEMVIEW_TRY(mounted.camera.fx_px, number("fx"));
  SEMVIEW_TRY(mounted.camera.fy_px, number("fy"));
  SEMVIEW_TRY(mounted.camera.cx_px, number("cx"));
  SEMVIEW_TRY(mounted.camera.cy_px, number("cy"));
  mounted.base_from_camera = base_from_optical(mount);
  if (const Status valid = validate(mounted); !valid) return node.error(valid.error().message);
  return mounted;
}

/// Ten digits: enough for any angle, and 45 stays 45.
std::string shown(double value) { return fmt::format("{:.10g}", value + 0.0); }

std::string format_mount(const Mount& mount) {
  return fmt::format(
      "base_from_camera: {{x: {}, y: {}, z: {}, roll_deg: {}, pitch_deg: {}, yaw_deg: {}}}\n",
      shown(mount.position_m.x()),
      shown(mount.position_m.y()),
      shown(mount.position_m.z()),
      shown(deg_from_rad(mount.roll_rad)),
      shown(deg_from_rad(mount.pitch_rad)),
      shown(deg_from_rad(mount.yaw_rad)));
}

std::string format_camera(const PartialPanorama& camera) {
  return fmt::format(
             "panorama:\n  azimuth_left_deg: {}\n  azimuth_right_deg: {}\n"
             "  elevation_min_deg: {}\n  elevation_max_deg: {}\n",
             shown(deg_from_rad(camera.azimuth_left_rad)),
             shown(deg_from_rad(camera.azimuth_right_rad)),
             shown(deg_from_rad(camera.elevation_min_rad)),
             shown(deg_from_rad(camera.elevation_max_rad))) +
         format_mount({camera.position_m, 0.0, 0.0, 0.0});
}

std::string format_camera(const MountedPinhole& mounted) {
  const PinholeCamera& camera = mounted.camera;
  return fmt::format("pinhole: {{width: {}, height: {}, fx: {}, fy: {}, cx: {}, cy: {}}}\n",
                     camera.columns,
                     camera.rows,
                     shown(camera.fx_px),
                     shown(camera.fy_px),
                     shown(camera.cx_px),
                     shown(camera.cy_px)) +
         format_mount(mount_of(mounted.base_from_camera));
}

/// The setup's camera with the size of the image at hand, if the two fit.
Result<ObservationCamera> camera_of_size(const ObservationCamera& camera,
                                         const LabelImage& labels,
                                         const std::string& file) {
  if (const auto* panorama = std::get_if<PartialPanorama>(&camera)) {
    PartialPanorama sized = *panorama;
    sized.rows = labels.rows();
    sized.columns = labels.columns();
    return ObservationCamera(sized);
  }
  const PinholeCamera& pinhole = std::get<MountedPinhole>(camera).camera;
  if (pinhole.rows != labels.rows() || pinhole.columns != labels.columns()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: {} x {} pixels, expected the pinhole camera's {} x {}",
                            file,
                            labels.columns(),
                            labels.rows(),
                            pinhole.columns,
                            pinhole.rows));
  }
  return camera;
}

}  // namespace

Result<ObservationSetup> parse_observation_setup(const YamlNode& document) {
  SEMVIEW_TRY(const YamlNode format_node, document.at("format"));
  SEMVIEW_TRY(const std::int64_t format, format_node.integer());
  if (format != kFormat) {
    return fail(
        ErrorCode::kUnimplemented,
        fmt::format("{}: format {}, this version reads {}", format_node.where(), format, kFormat));
  }
  ObservationSetup setup;
  SEMVIEW_TRY(const YamlNode classes, document.at("classes"));
  SEMVIEW_TRY(setup.classes, parse_classes(classes));
  SEMVIEW_TRY(const Mount mount, parse_mount(document));
  const std::optional<YamlNode> panorama = document.find("panorama");
  const std::optional<YamlNode> pinhole = document.find("pinhole");
  if (panorama.has_value() == pinhole.has_value()) {
    return document.error("expected either 'panorama' or 'pinhole'");
  }
  if (panorama) {
    SEMVIEW_TRY(setup.camera, parse_panorama(*panorama, mount));
  } else {
    SEMVIEW_TRY(setup.camera, parse_pinhole(*pinhole, mount));
  }
  return setup;
}

std::string format_observation_setup(const ObservationSetup& setup) {
  std::string text = fmt::format("format: {}\n", kFormat);
  text += std::visit([](const auto& camera) { return format_camera(camera); }, setup.camera);
  text += "classes:\n";
  for (const std::string& name : setup.classes.names()) text += "  - " + quoted_yaml(name) + '\n';
  return text;
}

Result<Observation> read_labels(const std::filesystem::path& path,
                                const ObservationSetup& setup,
                                double stamp_s,
                                const PanoramaCamera& profile) {
  SEMVIEW_TRY(const LabelImage labels, read_png_grey(path));
  for (int row = 0; row < labels.rows(); ++row) {
    for (int column = 0; column < labels.columns(); ++column) {
      const ClassId id = labels.at(row, column);
      if (id > setup.classes.size() && id != kUnknown) {
        return fail(ErrorCode::kInvalidArgument,
                    fmt::format("{}: pixel at row {}, column {} has id {}, expected up to {} (the "
                                "number of classes) or 255",
                                path.string(),
                                row,
                                column,
                                id,
                                setup.classes.size()));
      }
    }
  }
  SEMVIEW_TRY(const ObservationCamera camera, camera_of_size(setup.camera, labels, path.string()));
  return Observation{
      setup.classes, resample(labels, camera, profile), stamp_s, base_from_eye(camera)};
}

Result<Observation> read_observation(const std::filesystem::path& directory,
                                     const PanoramaCamera& profile) {
  SEMVIEW_TRY(const YamlNode document, read_yaml(directory / "observation.yaml"));
  SEMVIEW_TRY_STATUS(document.expect_keys(
      {"format", "stamp", "classes", "panorama", "pinhole", "base_from_camera"}));
  SEMVIEW_TRY(const double stamp_s, document.number_or("stamp", 0.0));
  SEMVIEW_TRY(const ObservationSetup setup, parse_observation_setup(document));
  return read_labels(directory / "labels.png", setup, stamp_s, profile);
}

Status write_observation(const std::filesystem::path& directory,
                         const ObservationSetup& setup,
                         const LabelImage& labels,
                         double stamp_s) {
  SEMVIEW_TRY_STATUS(camera_of_size(setup.camera, labels, (directory / "labels.png").string()));
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) {
    return fail(ErrorCode::kUnavailable,
                fmt::format("{}: cannot be made: {}", directory.string(), error.message()));
  }
  SEMVIEW_TRY_STATUS(write_png(directory / "labels.png", labels));
  return write_text_file(directory / "observation.yaml",
                         fmt::format("stamp: {:.9f}\n", stamp_s) + format_observation_setup(setup));
}

}  // namespace semview::io
