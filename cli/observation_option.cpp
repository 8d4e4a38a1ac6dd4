// SPDX-License-Identifier: Apache-2.0
#include "observation_option.hpp"

#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "semview/io/observation_folder.hpp"
#include "semview/io/run_log.hpp"

namespace semview::cli {

void add_observation_option(CLI::App& verb, ObservationOption& option) {
  verb.add_option("--obs", option.folder, "Observation folder, or a run log with --frame")
      ->type_name("DIR")
      ->required();
  verb.add_option("--frame", option.frame, "Frame of the run log, from 0")->type_name("N");
}

Result<Observation> read(const ObservationOption& option, const PanoramaCamera& profile) {
  const std::filesystem::path folder(option.folder);
  std::error_code ignored;
  const bool is_run_log = std::filesystem::exists(folder / "log.yaml", ignored);
  if (!is_run_log && !std::filesystem::exists(folder / "observation.yaml", ignored)) {
    return fail(Error{ErrorCode::kNotFound,
                      fmt::format("{}: has neither observation.yaml nor log.yaml, expected an "
                                  "observation folder or a run log",
                                  option.folder),
                      "--obs"});
  }
  if (!option.frame && !is_run_log) return io::read_observation(option.folder, profile);
  SEMVIEW_TRY(const io::RunLog log, io::read_run_log(option.folder));
  if (!option.frame || *option.frame >= log.frames.size()) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("{}: is a run log of {} frames; expected --frame 0 to {}",
                                  option.folder,
                                  log.frames.size(),
                                  log.frames.size() - 1),
                      "--frame"});
  }
  return io::read_frame(log, *option.frame, profile);
}

}  // namespace semview::cli
