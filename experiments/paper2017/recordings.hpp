// SPDX-License-Identifier: Apache-2.0
/// Anybody's recorded drives with the methods of the experiment, for the same tables.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiment.hpp"
#include "foreign_estimates.hpp"
#include "methods.hpp"
#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/view_source.hpp"
#include "trial.hpp"

namespace semview::paper2017 {

/// A drive with ground truth, ready for `run_trial`.
struct Recording {
  std::string name;               ///< its row's in tables
  std::vector<double> stamps_s;   ///< of the frames of `world`
  std::vector<double> skipped_s;  ///< of frames that are not compared
  RowWorld world;
};

struct RecordingsConfig {
  int runs = 10;
  std::uint64_t seed = 1;
  std::vector<std::string> methods = {"identity", "weighted", "ours"};
  std::vector<Start> starts = {Start::kLocal};
};

/// What the methods score with, of the recordings' classes and the map's.
struct RecordingWeights {
  similarity::WeightMatrix identity;
  similarity::WeightMatrix hand;
  /// For methods that learn; without it they take `hand` as it is weighed without learning.
  std::optional<similarity::WeightMatrix> learned;
};

/// The row that stands for all recordings, where there are several.
inline constexpr const char* kAllRecordings = "all logs";

/// @errors kInvalidArgument, with the option of the command line as the error's field.
Status validate(const RecordingsConfig& config);

/// Each recording with each method, start and filter seed: a row a recording, and where there are
/// several one over all of them, in which recordings are what worlds are elsewhere. Equal
/// arguments give equal records but for their times, whatever the pool.
/// @param progress  called with how many drives of how many are done, by one thread at a time
/// @errors those of `validate` and of scoring.
Result<Experiment> run_recordings(const RecordingsConfig& config,
                                  const std::vector<Recording>& recordings,
                                  const RecordingWeights& weights,
                                  ViewSource& views,
                                  ThreadPool& pool,
                                  const std::function<void(std::size_t, std::size_t)>& progress);

/// Another program's trajectories, `DIR/NAME.tum` for the recording NAME.
/// @errors those of `check_foreign_name` and of `evaluation::read_poses_at`; kNotFound: a recording
/// without a file.
Result<std::vector<TrialRecord>> read_recording_estimates(const ForeignEstimates& estimates,
                                                          const std::vector<Recording>& recordings,
                                                          Start start);

/// Adds drives of `run_recordings`' rows, to that of all recordings too.
void add_trials(const std::vector<TrialRecord>& trials, Experiment& experiment);

}  // namespace semview::paper2017
