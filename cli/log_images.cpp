// SPDX-License-Identifier: Apache-2.0
#include "log_images.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "observe_options.hpp"

namespace semview::cli {

Result<std::optional<Observation>> LogImages::observe(std::size_t frame,
                                                      const PanoramaCamera& profile) const {
  const io::FrameFiles& files = log_.frames[frame];
  std::vector<std::filesystem::path> photos;
  for (const std::string& file : files.images()) photos.push_back(log_.directory / file);
  if (photos.empty()) return std::optional<Observation>();
  Result<Observation> seen = labeller_.observe(photos, files.stamp_s, profile);
  if (!seen) return with_context(std::move(seen), fmt::format("frame {}", frame));
  return std::optional(*std::move(seen));
}

Result<std::optional<LogImages>> open_log_images(const io::RunLog& log, const std::string& model) {
  const auto any = [&log](std::string io::FrameFiles::*file) {
    return std::ranges::any_of(
        log.frames, [file](const io::FrameFiles& frame) { return !(frame.*file).empty(); });
  };
  const bool has_images = any(&io::FrameFiles::image);
  if (model.empty()) {
    if (!has_images || any(&io::FrameFiles::labels)) return std::optional<LogImages>();
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("{}: holds images and no labels; expected --segment with the "
                                  "network that shall label them, for example --segment {}",
                                  log.directory.string(),
                                  kDefaultModel),
                      "--segment"});
  }
  if (!has_images) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("--segment: {} holds no images", log.directory.string()),
                      "--segment"});
  }
  segmentation::CameraRig rig = segmentation::rig_of(log.setup.camera);
  if (log.camera_rig) {
    SEMVIEW_TRY(rig, segmentation::read_camera_rig(*log.camera_rig));
  }
  SEMVIEW_TRY(std::unique_ptr<segmentation::Segmenter> segmenter, open_segmenter(model));
  return std::optional<LogImages>(
      std::in_place, log, PhotoLabeller{std::move(rig), std::move(segmenter)});
}

}  // namespace semview::cli
