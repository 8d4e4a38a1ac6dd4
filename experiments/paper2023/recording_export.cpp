// SPDX-License-Identifier: Apache-2.0
#include "recording_export.hpp"

#include <cmath>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "experiments/paper2017/export_folder.hpp"
#include "semview/io/png.hpp"
#include "semview/io/run_log.hpp"
#include "semview/io/text_file.hpp"
#include "semview/io/trajectory.hpp"
#include "things.hpp"

namespace semview::paper2023 {
namespace {

namespace fs = std::filesystem;

Image<std::uint16_t> millimetres(const Image<float>& depth_m) {
  Image<std::uint16_t> whole(depth_m.rows(), depth_m.columns());
  for (std::size_t i = 0; i < whole.pixels().size(); ++i) {
    whole.pixels()[i] =
        static_cast<std::uint16_t>(std::lround(double{depth_m.pixels()[i]} * 1000.0));
  }
  return whole;
}

std::vector<io::StampedPose2> track(const Recording& recording, Pose2 RecordedFrame::*pose) {
  std::vector<io::StampedPose2> stamped;
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    stamped.push_back({stamp_s(i), recording.frames[i].*pose});
  }
  return stamped;
}

Status write_log(const Recording& recording, bool with_poses, const fs::path& directory) {
  const io::ObservationSetup setup{thing_classes(),
                                   MountedPinhole{recording.camera, recording.base_from_camera}};
  SEMVIEW_TRY(io::RunLogWriter log,
              io::RunLogWriter::create(directory, setup, "semview evaluate paper2023 --export"));
  for (const char* folder : {"depth", "labels_gt", "labels_rcnn"}) {
    std::error_code ignored;  // of what cannot be made the pictures say so
    fs::create_directories(directory / folder, ignored);
  }
  std::vector<io::StampedPose3> poses;
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    const RecordedFrame& frame = recording.frames[i];
    const std::string file = fmt::format("{:06}.png", i);
    SEMVIEW_TRY_STATUS(io::write_png(directory / "depth" / file, millimetres(frame.depth_m)));
    SEMVIEW_TRY_STATUS(io::write_png(directory / "labels_gt" / file, frame.labels_gt));
    SEMVIEW_TRY_STATUS(io::write_png(directory / "labels_rcnn" / file, frame.labels_rcnn));
    SEMVIEW_TRY_STATUS(log.add_files({stamp_s(i), "labels_gt/" + file, "depth/" + file, {}}));
    poses.push_back({stamp_s(i), frame.map_from_camera});
  }
  if (with_poses) SEMVIEW_TRY_STATUS(io::write_tum_poses(directory / "poses.txt", poses));
  return log.finish(track(recording, &RecordedFrame::odom_from_base), {});
}

/// One recording of a world.
struct Entry {
  std::uint64_t world = 1;
  Session session = Session::kStatic;
  int path = -1;  ///< -1: the survey

  std::string name() const {
    return path < 0 ? "survey" : fmt::format("{}_{}", paper2023::name(session), path);
  }
  Recording record(const WorldConfig& config, ThreadPool& pool) const {
    return path < 0 ? record_survey(config, world, pool)
                    : record_path(config, world, session, path, pool);
  }
};

std::vector<Entry> entries_of(const ExportConfig& config) {
  std::vector<Entry> entries;
  for (const std::uint64_t world : config.worlds) {
    entries.push_back({world, Session::kStatic, -1});
    for (int i = 0; i < config.static_paths; ++i) entries.push_back({world, Session::kStatic, i});
    for (int i = 0; i < config.changed_paths; ++i) {
      entries.push_back({world, Session::kChanged, i});
    }
  }
  return entries;
}

}  // namespace

Status validate(const ExportConfig& config) {
  const auto refuse = [](const char* option, std::string message) {
    return fail(Error{ErrorCode::kInvalidArgument, std::move(message), option});
  };
  if (config.worlds.empty()) return refuse("--worlds", "--worlds: expected a seed at least");
  if (std::set(config.worlds.begin(), config.worlds.end()).size() != config.worlds.size()) {
    return refuse("--worlds", "--worlds: expected each seed once");
  }
  constexpr int kMaxPaths = 100;
  for (const int paths : {config.static_paths, config.changed_paths}) {
    if (paths < 0 || paths > kMaxPaths) {
      return refuse("--paths", fmt::format("--paths {}: expected 0 to {}", paths, kMaxPaths));
    }
  }
  return {};
}

double stamp_s(std::size_t frame) { return static_cast<double>(frame) / 2.0; }

Status export_recordings(const ExportConfig& config,
                         const std::filesystem::path& directory,
                         const std::function<void(std::size_t, std::size_t)>& progress) {
  SEMVIEW_TRY_STATUS(validate(config));
  SEMVIEW_TRY(const auto folder, paper2017::ExportFolder::begin(directory));
  const fs::path& unfinished = folder.unfinished();
  ThreadPool pool(config.threads);
  const std::vector<Entry> entries = entries_of(config);
  std::string list = "world,session,path,log,estimate\n";
  std::size_t done = 0;
  for (const Entry& entry : entries) {
    const std::string place = fmt::format("world_{}/{}", entry.world, entry.name());
    const Recording recording = entry.record(config.world, pool);
    std::error_code ignored;
    fs::create_directories((unfinished / "truth" / place).parent_path(), ignored);
    fs::create_directories((unfinished / "input" / place).parent_path(), ignored);
    SEMVIEW_TRY_STATUS(write_log(recording, entry.path < 0, unfinished / "input" / place));
    SEMVIEW_TRY_STATUS(io::write_tum(unfinished / "truth" / (place + ".tum"),
                                     track(recording, &RecordedFrame::map_from_base)));
    list += entry.path < 0 ? fmt::format("{},survey,,{},\n", entry.world, place)
                           : fmt::format("{},{},{},{},{}.tum\n",
                                         entry.world,
                                         name(entry.session),
                                         entry.path,
                                         place,
                                         place);
    progress(++done, entries.size());
  }
  SEMVIEW_TRY_STATUS(io::write_text_file(unfinished / "input" / "list.csv", list));
  return folder.finish();
}

}  // namespace semview::paper2023
