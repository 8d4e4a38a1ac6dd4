// SPDX-License-Identifier: Apache-2.0
#include "semview/io/run_log.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/io/output_path.hpp"
#include "semview/io/png.hpp"
#include "semview/io/range_png.hpp"
#include "semview/io/text_file.hpp"

namespace semview::io {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{256} << 20U;
constexpr std::string_view kFramesHeader = "timestamp,labels,depth,image";

/// A name that stays inside the log's folder.
bool is_inside(std::string_view name) {
  const std::filesystem::path path(name);
  if (path.is_absolute()) return false;
  return std::ranges::none_of(path, [](const std::filesystem::path& part) { return part == ".."; });
}

Result<FrameFiles> parse_frame(std::string_view line, const std::string& where) {
  std::array<std::string_view, 4> cells;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t comma = line.find(',');
    const bool last = i + 1 == cells.size();
    if (last != (comma == std::string_view::npos)) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}: expected four columns: {}", where, kFramesHeader));
    }
    cells[i] = line.substr(0, comma);
    if (!last) line.remove_prefix(comma + 1);
  }
  FrameFiles frame{0.0, std::string(cells[1]), std::string(cells[2]), std::string(cells[3])};
  const char* const end = cells[0].data() + cells[0].size();
  const auto [stop, status] = std::from_chars(cells[0].data(), end, frame.stamp_s);
  if (status != std::errc() || stop != end || !std::isfinite(frame.stamp_s)) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: timestamp '{}' is not a number of seconds", where, cells[0]));
  }
  std::vector<std::string> names = frame.images();
  names.insert(names.end(), {frame.labels, frame.depth});
  for (const std::string& name : names) {
    if (!is_inside(name)) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}: file '{}' is not inside the log's folder", where, name));
    }
  }
  return frame;
}

Result<std::vector<FrameFiles>> read_frames(const std::filesystem::path& path) {
  SEMVIEW_TRY(const std::string text, read_text_file(path, kMaxBytes));
  std::vector<FrameFiles> frames;
  std::string_view rest = text;
  for (int line_number = 1; !rest.empty(); ++line_number) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    const std::string where = fmt::format("{}:{}", path.string(), line_number);
    if (line_number == 1) {
      if (line == kFramesHeader) continue;
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}: expected the header {}", where, kFramesHeader));
    }
    if (line.empty()) continue;
    SEMVIEW_TRY(FrameFiles frame, parse_frame(line, where));
    if (!frames.empty() && frame.stamp_s <= frames.back().stamp_s) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}: timestamp {:.9f} is not above {:.9f} of the frame before",
                              where,
                              frame.stamp_s,
                              frames.back().stamp_s));
    }
    frames.push_back(std::move(frame));
  }
  if (frames.empty()) {
    return fail(ErrorCode::kInvalidArgument, fmt::format("{}: holds no frame", path.string()));
  }
  return frames;
}

/// What took the frames, and the classes of their labels if they have any.
Status read_setup(const YamlNode& document, RunLog& log) {
  SEMVIEW_TRY_STATUS(document.expect_keys(
      {"format", "note", "classes", "panorama", "pinhole", "base_from_camera", "camera_rig"}));
  const bool labelled = std::ranges::any_of(
      log.frames, [](const FrameFiles& frame) { return !frame.labels.empty(); });
  const std::optional<YamlNode> rig = document.find("camera_rig");
  if (!rig && (labelled || document.find("classes"))) {
    SEMVIEW_TRY(log.setup, parse_observation_setup(document));
    return {};
  }
  if (!rig) {
    SEMVIEW_TRY(log.setup.camera, parse_observation_camera(document));
    return {};
  }
  SEMVIEW_TRY(const std::string name, rig->text());
  if (!is_inside(name)) {
    return rig->error(fmt::format("file '{}' is not inside the log's folder", name));
  }
  if (labelled) {
    return rig->error("frames with labels have one camera: expected 'panorama' or 'pinhole'");
  }
  for (const char* key : {"panorama", "pinhole", "base_from_camera", "classes"}) {
    if (const std::optional<YamlNode> other = document.find(key)) {
      return other->error(
          fmt::format("'{}' beside 'camera_rig', which says what took the images", key));
    }
  }
  log.camera_rig = log.directory / name;
  return {};
}

}  // namespace

std::vector<std::string> FrameFiles::images() const {
  std::vector<std::string> files;
  std::string_view rest = image;
  while (!rest.empty()) {
    const std::string_view file = rest.substr(0, rest.find(';'));
    rest.remove_prefix(std::min(file.size() + 1, rest.size()));
    if (!file.empty()) files.emplace_back(file);
  }
  return files;
}

Result<RunLog> read_run_log(const std::filesystem::path& directory) {
  std::error_code ignored;
  if (!std::filesystem::exists(directory / "log.yaml", ignored)) {
    const bool there = std::filesystem::is_directory(directory, ignored);
    return fail(Error{ErrorCode::kNotFound,
                      fmt::format("{}: {}, expected a run log",
                                  directory.string(),
                                  there ? "has no log.yaml" : "is no folder"),
                      {},
                      "a run log is a folder with log.yaml, frames.csv and odometry.txt; `semview "
                      "simulate` writes one"});
  }
  RunLog log;
  log.directory = directory;
  SEMVIEW_TRY(const YamlNode document, read_yaml(directory / "log.yaml"));
  SEMVIEW_TRY(log.frames, read_frames(directory / "frames.csv"));
  SEMVIEW_TRY_STATUS(read_setup(document, log));
  SEMVIEW_TRY(log.odometry, read_tum(directory / "odometry.txt"));
  if (std::filesystem::exists(directory / "groundtruth.txt", ignored)) {
    SEMVIEW_TRY(log.groundtruth, read_tum(directory / "groundtruth.txt"));
  }
  return log;
}

Result<Observation> read_frame(const RunLog& log,
                               std::size_t index,
                               const PanoramaCamera& profile) {
  SEMVIEW_CHECK(index < log.frames.size());
  const FrameFiles& frame = log.frames[index];
  if (frame.labels.empty()) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: frame {} at {:.9f} s has no labels",
                            (log.directory / "frames.csv").string(),
                            index,
                            frame.stamp_s));
  }
  return read_labels(log.directory / frame.labels, log.setup, frame.stamp_s, profile);
}

Result<Image<float>> read_depth(const RunLog& log, std::size_t index) {
  SEMVIEW_CHECK(index < log.frames.size());
  const FrameFiles& frame = log.frames[index];
  if (frame.depth.empty()) {
    return fail(ErrorCode::kNotFound, "no depth in frames.csv");
  }
  SEMVIEW_TRY(const Image<std::uint16_t> millimetres, read_png_grey16(log.directory / frame.depth));
  return depth_m(millimetres);
}

Result<RunLogWriter> RunLogWriter::create(const std::filesystem::path& directory,
                                          const ObservationSetup& setup,
                                          const std::string& note) {
  std::error_code error;
  if (std::filesystem::exists(directory / "log.yaml", error)) {
    return fail(ErrorCode::kAlreadyExists,
                fmt::format("{}: holds a run log already, expected a new or empty folder",
                            directory.string()));
  }
  SEMVIEW_TRY_STATUS(check_holds_nothing_else(directory, FolderKind::kRunLog));
  std::filesystem::create_directories(directory, error);
  if (error) {
    return fail(ErrorCode::kUnavailable,
                fmt::format("{}: cannot be made: {}", directory.string(), error.message()));
  }
  RunLogWriter writer;
  writer.directory_ = directory;
  writer.setup_ = setup;
  writer.note_ = note;
  return writer;
}

Status RunLogWriter::add_frame(double stamp_s, const LabelImage& labels) {
  const std::string name = fmt::format("labels/{:06}.png", frames_.size());
  SEMVIEW_TRY_STATUS(add_files({stamp_s, name, {}, {}}));
  std::error_code ignored;  // of what cannot be made the picture says so
  std::filesystem::create_directories(directory_ / "labels", ignored);
  return write_png(directory_ / name, labels);
}

Status RunLogWriter::add_files(FrameFiles frame) {
  if (!frames_.empty() && frame.stamp_s <= frames_.back().stamp_s) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("frame stamp {:.9f} is not above {:.9f} of the frame before",
                            frame.stamp_s,
                            frames_.back().stamp_s));
  }
  frames_.push_back(std::move(frame));
  return {};
}

Status RunLogWriter::finish(std::span<const StampedPose2> odometry,
                            std::span<const StampedPose2> groundtruth) {
  std::string csv(kFramesHeader);
  csv += '\n';
  for (const FrameFiles& frame : frames_) {
    csv += fmt::format("{:.9f},{},{},{}\n", frame.stamp_s, frame.labels, frame.depth, frame.image);
  }
  SEMVIEW_TRY_STATUS(write_text_file(directory_ / "frames.csv", csv));
  SEMVIEW_TRY_STATUS(write_tum(directory_ / "odometry.txt", odometry));
  if (!groundtruth.empty()) {
    SEMVIEW_TRY_STATUS(write_tum(directory_ / "groundtruth.txt", groundtruth));
  }
  std::string text = format_observation_setup(setup_);
  if (!note_.empty()) text = "note: " + quoted_yaml(note_) + '\n' + text;
  return write_text_file(directory_ / "log.yaml", text);
}

}  // namespace semview::io
