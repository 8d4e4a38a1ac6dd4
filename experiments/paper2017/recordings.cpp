// SPDX-License-Identifier: Apache-2.0
#include "recordings.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "guard.hpp"
#include "semview/evaluation/poses_at.hpp"
#include "unit.hpp"

namespace semview::paper2017 {
namespace {

/// A method as these weights let it be.
Method fitted(Method method, const RecordingWeights& weights) {
  if (method.weights != WeightsKind::kLearned || weights.learned) return method;
  const Method& baseline = *find_method("weighted");
  method.weights = baseline.weights;
  method.weighting = baseline.weighting;
  return method;
}

const similarity::WeightMatrix& weights_of(const Method& method, const RecordingWeights& weights) {
  switch (method.weights) {
    case WeightsKind::kIdentity:
      return weights.identity;
    case WeightsKind::kLearned:
      return *weights.learned;
    case WeightsKind::kHand:
      break;
  }
  return weights.hand;
}

struct Drive {
  Method method;
  const Recording* recording = nullptr;
  TrialRecord record;
};

std::vector<Drive> list_drives(const RecordingsConfig& config,
                               const std::vector<Method>& methods,
                               const std::vector<Recording>& recordings,
                               const RecordingWeights& weights) {
  std::vector<Drive> drives;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    for (const Method& method : methods) {
      for (const Start start : config.starts) {
        for (int run = 1; run <= config.runs; ++run) {
          drives.push_back(
              {fitted(method, weights),
               &recordings[i],
               {recordings[i].name, method.id, start, i + 1, filter_seed(config.seed, run), {}}});
        }
      }
    }
  }
  return drives;
}

Row row_named(const std::string& name) {
  Row row;
  row.id = row.title = name;
  return row;
}

}  // namespace

Status validate(const RecordingsConfig& config) {
  const auto refuse = [](const char* option, std::string message) {
    return fail(Error{ErrorCode::kInvalidArgument, std::move(message), option});
  };
  if (config.runs < 1 || config.runs > 1000) {
    return refuse("--runs", fmt::format("--runs {}: expected 1 to 1000", config.runs));
  }
  SEMVIEW_TRY_STATUS(check_starts(config.starts));
  if (const auto methods = methods_by_id(config.methods); !methods) return fail(methods.error());
  return {};
}

Result<Experiment> run_recordings(const RecordingsConfig& config,
                                  const std::vector<Recording>& recordings,
                                  const RecordingWeights& weights,
                                  ViewSource& views,
                                  ThreadPool& pool,
                                  const std::function<void(std::size_t, std::size_t)>& progress) {
  SEMVIEW_TRY_STATUS(validate(config));
  SEMVIEW_TRY(const std::vector<Method> methods, methods_by_id(config.methods));
  std::vector<Drive> drives = list_drives(config, methods, recordings, weights);
  std::mutex mutex;
  Status first_error;
  std::size_t done = 0;
  pool.parallel_for(drives.size(), 1, [&](std::size_t begin, std::size_t end) {
    ThreadPool alone(1);
    for (std::size_t i = begin; i < end; ++i) {
      Drive& drive = drives[i];
      auto stops = run_trial(drive.recording->world,
                             drive.method,
                             drive.record.start,
                             weights_of(drive.method, weights),
                             views,
                             alone,
                             drive.record.filter_seed);
      const std::lock_guard lock(mutex);
      if (stops) {
        drive.record.stops = *std::move(stops);
      } else if (first_error) {
        first_error = fail(std::move(stops).error());
      }
      progress(++done, drives.size());
    }
  });
  SEMVIEW_TRY_STATUS(std::move(first_error));
  Experiment experiment;
  experiment.means_over = "logs";
  experiment.config.starts = config.starts;
  experiment.config.runs = config.runs;
  experiment.config.seed = config.seed;
  experiment.config.methods = config.methods;
  experiment.config.worlds.clear();
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    experiment.config.worlds.push_back(i + 1);
    experiment.rows.push_back(row_named(recordings[i].name));
  }
  if (recordings.size() > 1) experiment.rows.push_back(row_named(kAllRecordings));
  std::vector<TrialRecord> trials;
  for (Drive& drive : drives) trials.push_back(std::move(drive.record));
  add_trials(trials, experiment);
  return experiment;
}

Result<std::vector<TrialRecord>> read_recording_estimates(const ForeignEstimates& estimates,
                                                          const std::vector<Recording>& recordings,
                                                          Start start) {
  SEMVIEW_TRY_STATUS(check_foreign_name(estimates.name));
  std::vector<TrialRecord> trials;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const Recording& recording = recordings[i];
    const std::filesystem::path file = estimates.directory / (recording.name + ".tum");
    if (!std::filesystem::exists(file)) {
      return fail(ErrorCode::kNotFound,
                  fmt::format("{}: is missing; expected one for each of {} logs",
                              file.string(),
                              recordings.size()));
    }
    SEMVIEW_TRY(const std::vector<Pose2> poses,
                evaluation::read_poses_at(file, recording.stamps_s, recording.skipped_s));
    trials.push_back({recording.name,
                      estimates.name,
                      start,
                      i + 1,
                      1,
                      errors_of(poses, recording.world.truth, recording.world.odometry)});
  }
  return trials;
}

void add_trials(const std::vector<TrialRecord>& trials, Experiment& experiment) {
  const bool several = experiment.rows.back().id == kAllRecordings;
  for (const TrialRecord& trial : trials) {
    experiment.trials.push_back(trial);
    if (!several) continue;
    experiment.trials.push_back(trial);
    experiment.trials.back().row = kAllRecordings;
  }
}

}  // namespace semview::paper2017
