// SPDX-License-Identifier: Apache-2.0
#include "recordings.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "log_images.hpp"
#include "semview/io/run_log.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::cli {
namespace {

using paper2017::Recording;

/// The folder's own name: a row of tables, a field of CSV lines and a file's name.
Result<std::string> name_of(const std::string& log) {
  std::filesystem::path path = std::filesystem::path(log).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  std::string name = path.filename().string();
  if (name.empty() || name == "." || name == ".." || name == paper2017::kAllRecordings ||
      name.find_first_of(",|\"\n") != std::string::npos) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: expected a folder whose name can stand in a table: no comma, "
                            "quote or bar",
                            log));
  }
  return name;
}

Result<std::optional<Observation>> observe(const io::RunLog& log,
                                           const std::optional<LogImages>& images,
                                           std::size_t frame,
                                           const PanoramaCamera& profile) {
  if (images) return images->observe(frame, profile);
  if (log.frames[frame].labels.empty()) return std::optional<Observation>();
  SEMVIEW_TRY(Observation observation, io::read_frame(log, frame, profile));
  return std::optional(std::move(observation));
}

Result<Recording> read_recording(const std::string& directory,
                                 const std::string& segment,
                                 const PanoramaCamera& profile) {
  Recording recording;
  SEMVIEW_TRY(recording.name, name_of(directory));
  SEMVIEW_TRY(const io::RunLog log, io::read_run_log(directory));
  if (!log.groundtruth) {
    return fail(ErrorCode::kFailedPrecondition,
                fmt::format("{}: has no groundtruth.txt to compare with", directory));
  }
  SEMVIEW_TRY(const std::optional<LogImages> images, open_log_images(log, segment));
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    const double stamp_s = log.frames[i].stamp_s;
    const Result<Pose2> odometry = io::interpolate(log.odometry, stamp_s);
    const Result<Pose2> truth = io::interpolate(*log.groundtruth, stamp_s);
    std::optional<Observation> seen;
    if (odometry && truth) {
      SEMVIEW_TRY(seen, observe(log, images, i, profile));
    }
    if (!seen) {
      recording.skipped_s.push_back(stamp_s);
      continue;
    }
    recording.stamps_s.push_back(stamp_s);
    recording.world.odometry.push_back(*odometry);
    recording.world.truth.push_back(*truth);
    recording.world.observations.push_back(*std::move(seen));
  }
  if (recording.stamps_s.empty()) {
    return fail(ErrorCode::kFailedPrecondition,
                fmt::format("{}: none of {} frames has labels, odometry and ground truth",
                            directory,
                            log.frames.size()));
  }
  return recording;
}

}  // namespace

Result<ReadRecordings> read_recordings(const std::vector<std::string>& logs,
                                       const std::string& segment,
                                       const service::Site& site) {
  ReadRecordings read;
  for (const std::string& log : logs) {
    SEMVIEW_TRY(Recording recording, read_recording(log, segment, site.profile().camera));
    recording.world.free_cells = site.cells().free_cells();
    recording.world.map_classes = site.map().classes;
    const auto same_name = [&](const Recording& one) { return one.name == recording.name; };
    if (std::ranges::any_of(read.recordings, same_name)) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}: another log is called {}, too; expected names that tell them "
                              "apart",
                              log,
                              recording.name));
    }
    const ClassTable& classes = recording.world.observations.front().classes;
    if (read.recordings.empty()) {
      read.observed = classes;
    } else if (!std::ranges::equal(classes.names(), read.observed.names())) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}: has other classes than {}; expected logs that one weight matrix "
                              "fits",
                              log,
                              logs.front()));
    }
    if (!recording.skipped_s.empty()) {
      read.notes.push_back(fmt::format(
          "{}: {} of {} frames are not compared: without labels, odometry or ground truth",
          recording.name,
          recording.skipped_s.size(),
          recording.skipped_s.size() + recording.stamps_s.size()));
    }
    read.recordings.push_back(std::move(recording));
  }
  return read;
}

}  // namespace semview::cli
