// SPDX-License-Identifier: Apache-2.0
#include "fuse_frames.hpp"

#include <system_error>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "observe_options.hpp"
#include "semview/io/photo.hpp"

namespace semview::cli {
namespace {

/// Poses farther apart are not interpolated: a robot turns in that time.
constexpr double kMaxGap_s = 0.25;

/// Frame `map` (z up) from the frame of the poses.
Eigen::Matrix3d map_from_world(const std::string& up) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  // A world that began as a camera: x right, y down, z forward.
  if (up == "-y") rotation << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return rotation;
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
  frames.camera_ = mounted->camera;
  frames.options_ = options;
  const std::filesystem::path file =
      options.poses.empty() ? log.directory / "poses.txt" : options.poses;
  SEMVIEW_TRY(frames.poses_, io::read_tum_poses(file));
  const Eigen::Isometry3d turn(Eigen::Quaterniond(map_from_world(options.up)));
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
  std::filesystem::path file;
  if (!options_.labels.empty()) {
    file = options_.labels / std::filesystem::path(files.depth).stem().concat(".png");
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return LabelImage();
  } else if (!files.labels.empty()) {
    file = log_.directory / files.labels;
  } else {
    return LabelImage();
  }
  return io::read_label_image(file, log_.setup.classes);
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
