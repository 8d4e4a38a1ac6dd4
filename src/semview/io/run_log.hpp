// SPDX-License-Identifier: Apache-2.0
/// A robot's recorded drive: odometry, label images, ground truth. See docs/formats/run_log.md.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/io/observation_folder.hpp"
#include "semview/io/trajectory.hpp"

namespace semview::io {

/// One line of `frames.csv`; file names are relative to the log's folder, empty where absent.
struct FrameFiles {
  double stamp_s = 0.0;
  std::string labels;
  std::string depth;
  std::string image;  ///< of a rig of several cameras their images in its order, `;` between them

  /// The files of `image`.
  std::vector<std::string> images() const;
};

struct RunLog {
  std::filesystem::path directory;
  /// Without classes where no frame has labels; without meaning where there is a `camera_rig`.
  ObservationSetup setup;
  std::optional<std::filesystem::path>
      camera_rig;                      ///< what took the images, of a log without labels
  std::vector<StampedPose2> odometry;  ///< odom_from_base
  std::optional<std::vector<StampedPose2>> groundtruth;  ///< map_from_base
  std::vector<FrameFiles> frames;                        ///< stamps increase
};

/// Reads `log.yaml`, `odometry.txt`, `groundtruth.txt` (may be missing) and `frames.csv`. Images
/// are left on disk.
/// @errors kNotFound: a file is missing; kInvalidArgument with file and line: a damaged one, stamps
/// that do not increase, a file name that leaves the folder.
Result<RunLog> read_run_log(const std::filesystem::path& directory);

/// The labels of frame `index`, resampled to `profile`; `index` < frames.size().
/// @errors kNotFound: the frame has no labels, or their file is missing; others as `read_labels`.
Result<Observation> read_frame(const RunLog& log, std::size_t index, const PanoramaCamera& profile);

/// The depth of frame `index`, 16-bit PNG in whole millimetres, 0 where nothing was measured.
/// @errors kNotFound: the frame has no depth, or its file is missing; those of read_png_grey16.
Result<Image<float>> read_depth(const RunLog& log, std::size_t index);

/// Writes a run log: frames one by one, trajectories at the end.
class RunLogWriter {
 public:
  /// Makes the folder. `note` is one line for people: what made the log, and from what.
  /// @errors kAlreadyExists: `directory` holds a run log; kUnavailable: cannot be made.
  static Result<RunLogWriter> create(const std::filesystem::path& directory,
                                     const ObservationSetup& setup,
                                     const std::string& note = {});

  /// Writes `labels/NNNNNN.png`. Stamps must increase.
  /// @errors kInvalidArgument: a stamp that does not; kUnavailable: cannot be written.
  Status add_frame(double stamp_s, const LabelImage& labels);

  /// Lists a frame whose files the caller writes.
  /// @errors kInvalidArgument: a stamp that does not increase.
  Status add_files(FrameFiles frame);

  /// Writes `frames.csv`, `odometry.txt`, unless empty `groundtruth.txt`, and last `log.yaml`: a
  /// folder without it is no run log.
  Status finish(std::span<const StampedPose2> odometry, std::span<const StampedPose2> groundtruth);

 private:
  RunLogWriter() = default;

  std::filesystem::path directory_;
  ObservationSetup setup_;
  std::string note_;
  std::vector<FrameFiles> frames_;
};

}  // namespace semview::io
