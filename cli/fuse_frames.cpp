// SPDX-License-Identifier: Apache-2.0
#include "fuse_frames.hpp"

#include <system_error>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "observe_options.hpp"
#include "semview/io/instance_masks.hpp"
#include "semview/io/photo.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

/// Poses farther apart are not interpolated: a robot turns in that time.
constexpr double kMaxGap_s = 0.25;

/// Frame `map` (z up) from the frame of the poses, in which `up` points up: "z", "-y", or three
/// numbers. Where z does not point up it lies ahead: a world that began as a camera.
Result<Eigen::Matrix3d> map_from_world(const std::string& up) {
  if (up == "z") return Eigen::Matrix3d::Identity().eval();
  Eigen::Vector3d upward(0.0, -1.0, 0.0);
  if (up != "-y") {
    SEMVIEW_TRY(const std::vector<double> numbers, parse_numbers("--up", up, 3));
    upward = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
  }
  const Eigen::Vector3d ahead(0.0, 0.0, 1.0);
  const Eigen::Vector3d left = upward.cross(ahead);
  if (!(left.norm() > 1e-3)) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("--up {}: expected z, -y, or x,y,z not along z", up),
                      "--up"});
  }
  Eigen::Matrix3d rows;
  rows.row(2) = upward.normalized();
  rows.row(1) = left.normalized();
  rows.row(0) = rows.row(1).cross(rows.row(2));
  return rows;
}

Status check_labels(const std::filesystem::path& folder, const io::RunLog& log) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) {
    return fail(ErrorCode::kNotFound, fmt::format("--labels {}: no such folder", folder.string()));
  }
  if (log.setup.classes.size() > 0) return {};
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("{}: has no `classes`: the ids in {} have no names",
                          (log.directory / "log.yaml").string(),
                          folder.string()));
}

}  // namespace

Result<FuseFrames> FuseFrames::open(io::RunLog log, const FrameOptions& options) {
  const auto* mounted = std::get_if<MountedPinhole>(&log.setup.camera);
  if (mounted == nullptr || log.camera_rig) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: expected `pinhole`: depth is fused from a pinhole camera",
                            (log.directory / "log.yaml").string()));
  }
  if (!options.segment.empty() && !options.labels.empty()) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      "--segment and --labels both say where labels come from; expected one",
                      "--segment"});
  }
  FuseFrames frames;
  if (!options.labels.empty()) {
    SEMVIEW_TRY_STATUS(check_labels(options.labels, log));
  }
  frames.camera_ = mounted->camera;
  frames.options_ = options;
  const std::filesystem::path file =
      options.poses.empty() ? log.directory / "poses.txt" : options.poses;
  SEMVIEW_TRY(frames.poses_, io::read_tum_poses(file));
  SEMVIEW_TRY(const Eigen::Matrix3d rotation, map_from_world(options.up));
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.linear() = rotation;
  for (io::StampedPose3& sample : frames.poses_) sample.pose = turn * sample.pose;
  if (!options.segment.empty()) {
    SEMVIEW_TRY(frames.segmenter_, open_segmenter(options.segment));
  }
  frames.log_ = std::move(log);
  return frames;
}

const ClassTable& FuseFrames::classes() const {
  return segmenter_ ? segmenter_->classes() : log_.setup.classes;
}

Result<LabelImage> FuseFrames::read_labels(std::size_t index, const RgbImage& colour) const {
  const io::FrameFiles& files = log_.frames[index];
  if (segmenter_) {
    if (colour.pixels().empty()) return LabelImage();
    SEMVIEW_TRY(segmentation::Segmentation seen, segmenter_->segment(colour));
    return std::move(seen.labels);
  }
  const ClassTable& classes = log_.setup.classes;
  if (options_.labels.empty()) {
    if (files.labels.empty()) return LabelImage();
    return io::read_label_image(log_.directory / files.labels, classes);
  }
  const std::filesystem::path name = std::filesystem::path(files.depth).stem();
  std::error_code ignored;
  for (const char* ending : {".csv", ".png"}) {
    std::filesystem::path file = options_.labels / name;
    file += ending;
    if (!std::filesystem::exists(file, ignored)) continue;
    return file.extension() == ".csv" ? io::read_instance_masks(file, classes)
                                      : io::read_label_image(file, classes);
  }
  return LabelImage();
}

Fingerprint FuseFrames::fingerprint() const {
  Hasher hasher;
  for (const double number : {camera_.fx_px, camera_.fy_px, camera_.cx_px, camera_.cy_px}) {
    hasher.add_f64(number);
  }
  for (const io::StampedPose3& sample : poses_) {
    hasher.add_f64(sample.stamp_s);
    for (const double number : sample.pose.matrix().reshaped()) hasher.add_f64(number);
  }
  for (const io::FrameFiles& files : log_.frames) {
    hasher.add_f64(files.stamp_s);
    for (const std::string& name : {files.labels, files.depth, files.image}) {
      hasher.add_string(name);
    }
  }
  return hasher.digest();
}

Result<field::DepthFrame> FuseFrames::read(std::size_t index) const {
  const io::FrameFiles& files = log_.frames[index];
  field::DepthFrame frame;
  frame.camera = camera_;
  SEMVIEW_TRY(frame.map_from_camera, io::interpolate(poses_, files.stamp_s, kMaxGap_s));
  SEMVIEW_TRY(frame.depth_m, io::read_depth(log_, index));
  if (!files.image.empty()) {
    SEMVIEW_TRY(frame.colour, io::read_photo(log_.directory / files.image));
  }
  SEMVIEW_TRY(frame.labels, read_labels(index, frame.colour));
  return frame;
}

}  // namespace semview::cli
