// SPDX-License-Identifier: Apache-2.0
#include "experiment.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "flat_map.hpp"

namespace semview::paper2023 {
namespace {

std::vector<Method> methods_of(const ExperimentConfig& config) {
  if (config.methods.empty()) return default_methods();
  std::vector<Method> methods;
  for (const std::string& id : config.methods) methods.push_back(*find_method(id));
  return methods;
}

/// A flat and the maps of it, by label source.
struct MappedFlat {
  Area inside;
  std::array<std::shared_ptr<const field::DistanceField>, 2> maps;
};

/// One recording that all methods localize on.
struct Drive {
  std::size_t world = 0;  ///< in `ExperimentConfig::worlds`
  Session session = Session::kStatic;
  int path = 0;
  int runs = 0;
};

std::vector<Drive> drives_of(const ExperimentConfig& config) {
  std::vector<Drive> drives;
  for (std::size_t world = 0; world < config.worlds.size(); ++world) {
    for (int path = 0; path < config.static_paths; ++path) {
      drives.push_back({world, Session::kStatic, path, config.static_runs});
    }
    for (int path = 0; path < config.changed_paths; ++path) {
      drives.push_back({world, Session::kChanged, path, config.changed_runs});
    }
  }
  return drives;
}

class Runner {
 public:
  Runner(const ExperimentConfig& config,
         const std::function<void(std::size_t, std::size_t)>& progress)
      : config_(config),
        methods_(methods_of(config)),
        drives_(drives_of(config)),
        progress_(progress),
        pool_(config.threads) {}

  Result<std::vector<Run>> run() {
    SEMVIEW_TRY_STATUS(map_flats());
    std::vector<Result<std::vector<Run>>> results(drives_.size());
    std::mutex mutex;
    std::size_t done = 0;
    pool_.parallel_for(drives_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        results[i] = drive(drives_[i]);
        const std::lock_guard lock(mutex);
        progress_(++done, drives_.size());
      }
    });
    std::vector<Run> runs;
    for (Result<std::vector<Run>>& result : results) {
      SEMVIEW_TRY(std::vector<Run> of_drive, std::move(result));
      for (Run& run : of_drive) runs.push_back(std::move(run));
    }
    return runs;
  }

 private:
  Status map_flats() {
    for (const std::uint64_t world : config_.worlds) {
      MappedFlat flat;
      flat.inside = draw_flat(config_.world.flat, world).inside;
      const Recording survey = record_survey(config_.world, world, pool_);
      for (const LabelSource source : {LabelSource::kGt, LabelSource::kRcnnLike}) {
        const bool wanted = std::ranges::count(methods_, source, &Method::labels) > 0;
        if (!wanted) continue;
        SEMVIEW_TRY(flat.maps[static_cast<std::size_t>(source)], map_of(survey, source, pool_));
      }
      flats_.push_back(std::move(flat));
    }
    return {};
  }

  /// The same for all methods, so that they can be compared run by run.
  std::uint64_t filter_seed(const Drive& drive, int run) const {
    const std::uint64_t of_drive =
        Rng(config_.seed, name(drive.session), config_.worlds[drive.world]).next_u64();
    return Rng(of_drive, "filter", static_cast<std::uint64_t>(drive.path * 1000 + run)).next_u64();
  }

  Result<std::vector<Run>> drive(const Drive& drive) const {
    const std::uint64_t world = config_.worlds[drive.world];
    ThreadPool alone(1);
    const Recording recording = record_path(config_.world, world, drive.session, drive.path, alone);
    std::vector<std::uint64_t> seeds;
    for (int run = 0; run < drive.runs; ++run) seeds.push_back(filter_seed(drive, run));
    std::vector<Run> runs;
    for (const Method& method : methods_) {
      const MappedFlat& flat = flats_[drive.world];
      SEMVIEW_TRY(std::vector<std::vector<StopRecord>> records,
                  run_trials(recording,
                             flat.inside,
                             method,
                             configured(method, config_.filter),
                             flat.maps[static_cast<std::size_t>(method.labels)],
                             seeds));
      for (int run = 0; run < drive.runs; ++run) {
        runs.push_back({world,
                        drive.session,
                        drive.path,
                        run,
                        method.id,
                        std::move(records[static_cast<std::size_t>(run)])});
      }
    }
    return runs;
  }

  const ExperimentConfig& config_;
  std::vector<Method> methods_;
  std::vector<Drive> drives_;
  const std::function<void(std::size_t, std::size_t)>& progress_;
  ThreadPool pool_;
  std::vector<MappedFlat> flats_;
};

}  // namespace

Status validate(const ExperimentConfig& config) {
  const auto refuse = [](const char* option, std::string message) {
    return fail(Error{ErrorCode::kInvalidArgument, std::move(message), option});
  };
  if (const auto use = paper2017::check_worlds(config.worlds); !use) return fail(use.error());
  SEMVIEW_TRY_STATUS(paper2017::check_each_once("--methods", config.methods));
  for (const std::string& id : config.methods) {
    if (find_method(id) != nullptr) continue;
    std::string known;
    for (const Method& method : all_methods()) known += (known.empty() ? "" : ", ") + method.id;
    return refuse("--methods", fmt::format("--methods {}: expected some of {}", id, known));
  }
  for (const int count :
       {config.static_paths, config.static_runs, config.changed_paths, config.changed_runs}) {
    if (count < 1 || count > 100) {
      return refuse("--paths", fmt::format("{} paths or runs: expected 1 to 100", count));
    }
  }
  if (config.filter.particles < 1 || config.filter.particles > 1'000'000) {
    return refuse("--particles",
                  fmt::format("--particles {}: expected 1 to 1000000", config.filter.particles));
  }
  if (!(config.filter.temper > 0.0 && config.filter.temper <= 1.0)) {
    return refuse("--temper",
                  fmt::format("--temper {}: expected above 0, at most 1", config.filter.temper));
  }
  return field::validate(config.filter.model, kThingClassCount);
}

std::string describe(const ExperimentConfig& config) {
  return fmt::format("static: {} x {} runs a flat; changed: {} x {} runs; seed {}\n",
                     config.static_paths,
                     config.static_runs,
                     config.changed_paths,
                     config.changed_runs,
                     config.seed) +
         describe(config.world) + describe(config.filter) +
         "ours: outliers 0.2; sigma 1 m and 1 m; motion alpha 0.03 0.02 0.03 0.01\n";
}

Result<Experiment> run_experiment(const ExperimentConfig& config,
                                  const std::function<void(std::size_t, std::size_t)>& progress) {
  SEMVIEW_TRY_STATUS(validate(config));
  Experiment experiment;
  experiment.config = config;
  SEMVIEW_TRY(experiment.use, paper2017::check_worlds(config.worlds));
  SEMVIEW_TRY(experiment.runs, Runner(config, progress).run());
  return experiment;
}

std::string to_csv(const Experiment& experiment) {
  std::string text =
      "world,session,path,run,method,image,distance_m,position_error_m,heading_error_rad,"
      "effective_particles\n";
  for (const Run& run : experiment.runs) {
    for (std::size_t i = 0; i < run.stops.size(); ++i) {
      const StopRecord& stop = run.stops[i];
      text += fmt::format("{},{},{},{},{},{},{:.6f},{:.6f},{:.6f},{:.3f}\n",
                          run.world,
                          name(run.session),
                          run.path,
                          run.run,
                          run.method,
                          i,
                          stop.distance_m,
                          stop.position_m,
                          stop.heading_rad,
                          stop.effective_particles);
    }
  }
  return text;
}

}  // namespace semview::paper2023
