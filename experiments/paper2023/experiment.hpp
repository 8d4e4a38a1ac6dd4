// SPDX-License-Identifier: Apache-2.0
/// Maps flats, localizes on them as they were and after changes, and tells how far off it was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiments/paper2017/guard.hpp"
#include "methods.hpp"
#include "recording.hpp"
#include "semview/core/result.hpp"
#include "trial.hpp"

namespace semview::paper2023 {

struct ExperimentConfig {
  std::vector<std::uint64_t> worlds = {1, 2, 3, 4, 5, 6};
  std::vector<std::string> methods;  ///< ids; none: all
  int static_paths = 1;
  int static_runs = 5;
  int changed_paths = 4;
  int changed_runs = 3;
  std::uint64_t seed = 1;   ///< of the filters
  std::size_t threads = 0;  ///< 0: one a core
  WorldConfig world;
  FilterConfig filter;
};

/// @errors kInvalidArgument, with the option of the command line as the error's field.
Status validate(const ExperimentConfig& config);

/// All that a result depends on, a line each.
std::string describe(const ExperimentConfig& config);

/// One execution.
struct Run {
  std::uint64_t world = 1;
  Session session = Session::kStatic;
  int path = 0;
  int run = 0;
  std::string method;
  std::vector<StopRecord> stops;
};

struct Experiment {
  ExperimentConfig config;
  paper2017::WorldUse use = paper2017::WorldUse::kTest;
  std::vector<Run> runs;  ///< by worlds, sessions, paths, methods, executions
};

/// The same numbers for any number of threads.
/// @param progress  called with how many recordings of how many are done, by one thread at a time
/// @errors those of `validate`, of mapping and of scoring
Result<Experiment> run_experiment(const ExperimentConfig& config,
                                  const std::function<void(std::size_t, std::size_t)>& progress);

/// A line a run and image.
std::string to_csv(const Experiment& experiment);

}  // namespace semview::paper2023
