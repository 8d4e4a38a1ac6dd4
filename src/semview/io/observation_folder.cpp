// SPDX-License-Identifier: Apache-2.0
#include "semview/io/observation_folder.hpp"

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/io/camera_yaml.hpp"
#include "semview/io/png.hpp"
#include "semview/io/text_file.hpp"

namespace semview::io {
namespace {

constexpr int kFormat = 1;

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

/// A panorama's azimuths are counted from the robot's heading already.
Result<PartialPanorama> parse_level_panorama(const YamlNode& node, const CameraMount& mount) {
  if (mount.roll_rad != 0.0 || mount.pitch_rad != 0.0 || mount.yaw_rad != 0.0) {
    return node.error(
        "a panorama's azimuths are counted from the robot's heading: roll, pitch and yaw of "
        "base_from_camera must be 0");
  }
  SEMVIEW_TRY(PartialPanorama camera, parse_panorama(node));
  camera.position_m = mount.position_m;
  return camera;
}

/// Ten digits: enough for any angle, and 45 stays 45.
std::string shown(double value) { return fmt::format("{:.10g}", value + 0.0); }

std::string format_mount(const CameraMount& mount) {
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

Result<LabelImage> read_label_image(const std::filesystem::path& path, const ClassTable& classes) {
  SEMVIEW_TRY(LabelImage labels, read_png_grey(path));
  for (int row = 0; row < labels.rows(); ++row) {
    for (int column = 0; column < labels.columns(); ++column) {
      const ClassId id = labels.at(row, column);
      if (id > classes.size() && id != kUnknown) {
        return fail(ErrorCode::kInvalidArgument,
                    fmt::format("{}: pixel at row {}, column {} has id {}, expected up to {} (the "
                                "number of classes) or 255",
                                path.string(),
                                row,
                                column,
                                id,
                                classes.size()));
      }
    }
  }
  return labels;
}

Result<ObservationCamera> parse_observation_camera(const YamlNode& document) {
  SEMVIEW_TRY(const YamlNode format_node, document.at("format"));
  SEMVIEW_TRY(const std::int64_t format, format_node.integer());
  if (format != kFormat) {
    return fail(
        ErrorCode::kUnimplemented,
        fmt::format("{}: format {}, this version reads {}", format_node.where(), format, kFormat));
  }
  SEMVIEW_TRY(const CameraMount mount, parse_mount(document));
  const std::optional<YamlNode> panorama = document.find("panorama");
  const std::optional<YamlNode> pinhole = document.find("pinhole");
  if (panorama.has_value() == pinhole.has_value()) {
    return document.error("expected either 'panorama' or 'pinhole'");
  }
  if (panorama) {
    SEMVIEW_TRY(PartialPanorama camera, parse_level_panorama(*panorama, mount));
    return ObservationCamera(camera);
  }
  SEMVIEW_TRY(const PinholeCamera camera, parse_pinhole(*pinhole));
  return ObservationCamera(MountedPinhole{camera, base_from_optical(mount)});
}

Result<ObservationSetup> parse_observation_setup(const YamlNode& document) {
  // A later format may spell its classes differently: it is refused first.
  const Result<ObservationCamera> camera = parse_observation_camera(document);
  if (!camera && camera.error().code == ErrorCode::kUnimplemented) return fail(camera.error());
  ObservationSetup setup;
  SEMVIEW_TRY(const YamlNode classes, document.at("classes"));
  SEMVIEW_TRY(setup.classes, parse_classes(classes));
  if (!camera) return fail(camera.error());
  setup.camera = *camera;
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
  SEMVIEW_TRY(const LabelImage labels, read_label_image(path, setup.classes));
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
  const std::filesystem::path labels_file = directory / "labels.png";
  SEMVIEW_TRY(Observation observation, read_labels(labels_file, setup, stamp_s, profile));
  const std::filesystem::path confidence_file = directory / "confidence.png";
  std::error_code ignored;
  if (!std::filesystem::exists(confidence_file, ignored)) return observation;
  SEMVIEW_TRY(const Image<std::uint8_t> confidence, read_png_grey(confidence_file));
  SEMVIEW_TRY(const LabelImage labels, read_png_grey(labels_file));
  if (confidence.rows() != labels.rows() || confidence.columns() != labels.columns()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: {} x {} pixels, expected the {} x {} of labels.png",
                            confidence_file.string(),
                            confidence.columns(),
                            confidence.rows(),
                            labels.columns(),
                            labels.rows()));
  }
  SEMVIEW_TRY(const ObservationCamera camera,
              camera_of_size(setup.camera, labels, labels_file.string()));
  observation.confidence =
      resample_confidence(confidence, labels, camera, profile, observation.labels);
  return observation;
}

Status write_observation(const std::filesystem::path& directory,
                         const ObservationSetup& setup,
                         const LabelImage& labels,
                         double stamp_s,
                         const Image<std::uint8_t>& confidence) {
  SEMVIEW_CHECK(confidence.empty() ||
                (confidence.rows() == labels.rows() && confidence.columns() == labels.columns()));
  SEMVIEW_TRY_STATUS(camera_of_size(setup.camera, labels, (directory / "labels.png").string()));
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) {
    return fail(ErrorCode::kUnavailable,
                fmt::format("{}: cannot be made: {}", directory.string(), error.message()));
  }
  SEMVIEW_TRY_STATUS(write_png(directory / "labels.png", labels));
  if (confidence.empty()) {
    std::filesystem::remove(directory / "confidence.png", error);  // of an observation before
  } else {
    SEMVIEW_TRY_STATUS(write_png(directory / "confidence.png", confidence));
  }
  return write_text_file(directory / "observation.yaml",
                         fmt::format("stamp: {:.9f}\n", stamp_s) + format_observation_setup(setup));
}

}  // namespace semview::io
