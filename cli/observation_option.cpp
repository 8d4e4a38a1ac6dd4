// SPDX-License-Identifier: Apache-2.0
#include "observation_option.hpp"

#include <filesystem>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "semview/io/observation_folder.hpp"
#include "semview/io/run_log.hpp"

namespace semview::cli {
namespace {

/// True for a run log, false for an observation folder.
Result<bool> finds_run_log(const ObservationOption& option) {
  const std::filesystem::path folder(option.folder);
  std::error_code ignored;
  if (std::filesystem::exists(folder / "log.yaml", ignored)) return true;
  if (std::filesystem::exists(folder / "observation.yaml", ignored)) return false;
  return fail(Error{ErrorCode::kNotFound,
                    fmt::format("{}: has neither observation.yaml nor log.yaml, expected an "
                                "observation folder or a run log",
                                option.folder),
                    "--obs"});
}

}  // namespace

void add_observation_option(CLI::App& verb, ObservationOption& option) {
  verb.add_option("--obs", option.folder, "Observation folder, or a run log with --frame")
      ->type_name("DIR")
      ->required();
  verb.add_option("--frame", option.frame, "Frame of the run log, from 0");
}

Result<ClassTable> read_observed_classes(const ObservationOption& option) {
  SEMVIEW_TRY(const bool is_run_log, finds_run_log(option));
  const std::filesystem::path folder(option.folder);
  SEMVIEW_TRY(const io::YamlNode document,
              io::read_yaml(folder / (is_run_log ? "log.yaml" : "observation.yaml")));
  SEMVIEW_TRY(io::ObservationSetup setup, io::parse_observation_setup(document));
  return std::move(setup.classes);
}

Result<Observation> read(const ObservationOption& option, const PanoramaCamera& profile) {
  SEMVIEW_TRY(const bool is_run_log, finds_run_log(option));
  if (!option.frame && !is_run_log) return io::read_observation(option.folder, profile);
  SEMVIEW_TRY(const io::RunLog log, read_log_of(option));
  return io::read_frame(log, *option.frame, profile);
}

Result<io::RunLog> read_log_of(const ObservationOption& option) {
  SEMVIEW_TRY(io::RunLog log, io::read_run_log(option.folder));
  if (!option.frame || *option.frame >= log.frames.size()) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("{}: is a run log of {} frames; expected --frame 0 to {}",
                                  option.folder,
                                  log.frames.size(),
                                  log.frames.size() - 1),
                      "--frame"});
  }
  return log;
}

std::optional<Pose2> true_pose(const io::RunLog& log, std::size_t frame) {
  if (!log.groundtruth) return std::nullopt;
  const Result<Pose2> pose = io::interpolate(*log.groundtruth, log.frames[frame].stamp_s);
  return pose ? std::optional(*pose) : std::nullopt;
}

}  // namespace semview::cli
