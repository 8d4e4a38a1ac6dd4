// SPDX-License-Identifier: Apache-2.0
/// Runs rows on worlds with methods and filter seeds, on several threads, and goes on where it was
/// stopped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "guard.hpp"
#include "methods.hpp"
#include "records.hpp"
#include "rows.hpp"
#include "semview/core/result.hpp"
#include "world.hpp"

namespace semview::paper2017 {

struct ExperimentConfig {
  std::vector<std::string> rows;  ///< ids; none: all, in the order of Fig. 3
  std::vector<std::uint64_t> worlds = {1, 2, 3, 4, 5, 6};
  int runs = 10;                ///< filter seeds a world, in 1..1000
  std::uint64_t seed = 1;       ///< of the filters
  std::size_t threads = 0;      ///< 0: one a core
  std::string engine = "auto";  ///< what casts the map's views
  /// Ids; none: identity, weighted and ours, and on the unmodified map weighted with odometry's
  /// heading, which Fig. 3 compares with the compass.
  std::vector<std::string> methods;
  std::vector<Start> starts = {Start::kLocal, Start::kGlobal};
  bool resume = false;  ///< keep what is finished in `out`
  std::filesystem::path out;
  WorldConfig world;
};

/// @errors kInvalidArgument, with the option of the command line as the error's field.
Status validate(const ExperimentConfig& config);

/// The rows that `config` asks for. @errors kInvalidArgument: an id that there is not.
Result<std::vector<Row>> rows_of(const ExperimentConfig& config);

/// All that a result depends on but rows and worlds, a line each.
std::string describe(const ExperimentConfig& config);

struct ExperimentProgress {
  std::size_t done = 0;  ///< units, those of an earlier run included
  std::size_t units = 0;
  double remaining_s = 0.0;  ///< guessed from what was done; 0 while nothing is
};

struct Experiment {
  ExperimentConfig config;
  WorldUse use = WorldUse::kTest;
  std::vector<Row> rows;
  std::vector<World> worlds;          ///< as `config.worlds`
  std::string means_over = "worlds";  ///< what tables call them
  std::vector<TrialRecord> trials;    ///< by rows, then worlds
  std::size_t units = 0;              ///< a row on a world each
  std::size_t kept_units = 0;         ///< of them, from an earlier run
};

/// Leaves in `config.out`: a file a row and world in `units/` (written when it is finished, with a
/// hash of the settings, and its times beside it), `runs.csv` with all of them, `plans/`, and
/// learned weights. `runs.csv` has the same bytes for any number of threads, resumed or not.
/// @param progress  called after each unit, by one thread at a time
/// @errors those of `validate`; kFailedPrecondition: `out` holds results and `resume` is not set,
/// or results of other settings; those of maps, scoring and writing.
Result<Experiment> run_experiment(const ExperimentConfig& config,
                                  const std::function<void(const ExperimentProgress&)>& progress);

}  // namespace semview::paper2017
