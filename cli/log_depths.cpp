// SPDX-License-Identifier: Apache-2.0
#include "log_depths.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "semview/core/log.hpp"
#include "semview/view/depth_observation.hpp"

namespace semview::cli {

Result<std::optional<Observation>> LogDepths::observe(std::size_t frame,
                                                      const PanoramaCamera& profile) const {
  const io::FrameFiles& files = log_.frames[frame];
  if (files.depth.empty()) return std::optional<Observation>();
  const auto& mounted = std::get<MountedPinhole>(log_.setup.camera);
  DepthObservation seen;
  seen.classes = log_.setup.classes;
  seen.camera = mounted.camera;
  seen.base_from_camera = mounted.base_from_camera;
  seen.stamp_s = files.stamp_s;
  SEMVIEW_TRY(seen.depth_m, io::read_depth(log_, frame));
  if (!files.labels.empty()) {
    SEMVIEW_TRY(seen.labels, io::read_label_image(log_.directory / files.labels, seen.classes));
  }
  Result<VoxelList> voxels = observation::reduce(seen, reduction_);
  if (!voxels) {
    log_warning(fmt::format("frame {}: {}", frame, voxels.error().message));
    return std::optional<Observation>();
  }
  const bool has_classes = std::ranges::any_of(
      voxels->voxels, [](const ObservedVoxel& voxel) { return voxel.label != kUnknown; });
  if (needs_classes_ && !has_classes) return std::optional<Observation>();
  Observation observation;
  observation.classes = seen.classes;
  observation.stamp_s = seen.stamp_s;
  if (with_panorama_) {
    if (!has_classes) return std::optional<Observation>();
    SEMVIEW_TRY(observation, io::read_frame(log_, frame, profile));
  }
  observation.voxels = *std::move(voxels);
  return std::optional(std::move(observation));
}

Result<std::optional<LogDepths>> open_log_depths(const io::RunLog& log,
                                                 const ModelOptions& options) {
  if (!scores_depth(options)) return std::optional<LogDepths>();
  if (log.camera_rig || !std::holds_alternative<MountedPinhole>(log.setup.camera)) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: expected `pinhole`: depth is that of a pinhole camera",
                            (log.directory / "log.yaml").string()));
  }
  const bool any = std::ranges::any_of(
      log.frames, [](const io::FrameFiles& frame) { return !frame.depth.empty(); });
  if (any) return std::optional<LogDepths>(std::in_place, log, options);
  return fail(
      ErrorCode::kInvalidArgument,
      fmt::format("{}: no frame has a depth image", (log.directory / "frames.csv").string()));
}

}  // namespace semview::cli
