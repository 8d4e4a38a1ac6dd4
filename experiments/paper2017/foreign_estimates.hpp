// SPDX-License-Identifier: Apache-2.0
/// Another program's trajectories as a method among those of the experiment.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiment.hpp"
#include "semview/core/result.hpp"
#include "semview/geometry/pose2.hpp"
#include "trial.hpp"

namespace semview::paper2017 {

/// `NAME=DIR` of the command line.
struct ForeignEstimates {
  std::string name;  ///< the column's
  std::filesystem::path directory;
};

struct ForeignDrive {
  std::string row;
  std::uint64_t world = 1;
  std::uint64_t run = 1;
  std::vector<Pose2> poses;  ///< one a stop, on the row's map
};

struct ForeignMethod {
  std::string name;
  std::vector<ForeignDrive> drives;
};

/// A name that can stand in tables and CSV files beside those of our methods.
/// @errors kInvalidArgument: it cannot, or a method of ours has it.
Status check_foreign_name(const std::string& name);

/// The errors of a pose for each stop, and odometry's beside them.
std::vector<StopRecord> errors_of(const std::vector<Pose2>& poses,
                                  const std::vector<Pose2>& truth,
                                  const std::vector<Pose2>& odometry);

/// Reads `DIR/ROW/world_W.tum`, as `list.csv` of an export names them, for each row and world of
/// `config`; a method that rolls dice may give several, `world_W.run_1.tum`, `world_W.run_2.tum` …
/// @errors kInvalidArgument: the name, or no world; kNotFound: a row and world without a file;
/// those of `evaluation::read_poses_at`.
Result<ForeignMethod> read_estimates(const ForeignEstimates& estimates,
                                     const ExperimentConfig& config);

/// Adds the drives to those of the experiment, with its first start.
void add_drives(const ForeignMethod& method, Experiment& experiment);

}  // namespace semview::paper2017
