// SPDX-License-Identifier: Apache-2.0
/// Frames of a run log as `semview fuse` takes them: depth, labels, colour, pose.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "semview/core/hash.hpp"
#include "semview/core/result.hpp"
#include "semview/field/fusion.hpp"
#include "semview/io/run_log.hpp"
#include "semview/segmentation/onnx_segmenter.hpp"

namespace semview::cli {

struct FrameOptions {
  std::filesystem::path poses;  ///< "": the log's `poses.txt`
  /// A folder with an image of label ids or a list of instance masks of each frame's name; "": the
  /// log's own labels.
  std::filesystem::path labels;
  std::string segment;   ///< the network that labels the images; "": none
  std::string up = "z";  ///< the axis of the poses' frame that points up: z or -y
};

class FuseFrames {
 public:
  /// @errors kInvalidArgument: a log whose camera is no pinhole, options that contradict; those of
  /// the files.
  static Result<FuseFrames> open(io::RunLog log, const FrameOptions& options);

  std::size_t size() const { return log_.frames.size(); }
  const ClassTable& classes() const;
  /// Of the camera, the poses, and the frames' stamps and names: another log has another.
  Fingerprint fingerprint() const;

  /// @errors why the frame cannot be used
  Result<field::DepthFrame> read(std::size_t index) const;

 private:
  Result<LabelImage> read_labels(std::size_t index, const RgbImage& colour) const;

  io::RunLog log_;
  FrameOptions options_;
  PinholeCamera camera_;
  std::vector<io::StampedPose3> poses_;
  std::unique_ptr<segmentation::OnnxSegmenter> segmenter_;
};

}  // namespace semview::cli
