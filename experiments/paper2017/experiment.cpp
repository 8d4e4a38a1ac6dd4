// SPDX-License-Identifier: Apache-2.0
#include "experiment.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "hand_matrix.hpp"
#include "learned_weights.hpp"
#include "row_map.hpp"
#include "semview/core/clock.hpp"
#include "semview/core/hash.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/io/output_path.hpp"
#include "semview/io/text_file.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "unit.hpp"
#include "unit_file.hpp"

namespace semview::paper2017 {
namespace {

std::string first_line(const ExperimentConfig& config) {
  Hasher hasher;
  hasher.add_string(describe(config));
  return fmt::format("# semview paper2017, settings {}\n", to_hex(hasher.digest()));
}

std::vector<std::string> default_methods(const Row& row) {
  std::vector<std::string> ids{"identity", "weighted", "ours"};
  if (row.id == "unmodified") ids.insert(ids.begin() + 2, "weighted_odometry");
  return ids;
}

Result<std::vector<Method>> methods_of(const ExperimentConfig& config, const Row& row) {
  return methods_by_id(config.methods.empty() ? default_methods(row) : config.methods);
}

/// The first line of a unit's file: what was made with other settings, or with other methods of
/// the row, is not mixed in.
std::string first_line_of(const ExperimentConfig& config, const Row& row) {
  ExperimentConfig of_row = config;
  if (of_row.methods.empty()) of_row.methods = default_methods(row);
  return first_line(of_row);
}

Status check_trials(std::string_view csv, std::string_view name) {
  const auto trials = parse_trials(csv, name);
  return trials ? Status() : fail(trials.error());
}

struct Unit {
  const Row* row = nullptr;
  std::size_t world = 0;  ///< in `Experiment::worlds`
  std::filesystem::path file;
  bool finished = false;
};

class Runner {
 public:
  Runner(Experiment& experiment, const std::function<void(const ExperimentProgress&)>& progress)
      : experiment_(experiment),
        config_(experiment.config),
        progress_(progress),
        pool_(config_.threads) {}

  Status run() {
    SEMVIEW_TRY_STATUS(list_units());
    make_worlds();
    SEMVIEW_TRY_STATUS(draw_plans());
    SEMVIEW_TRY_STATUS(prepare_weights());
    SEMVIEW_TRY_STATUS(run_units());
    return collect();
  }

 private:
  /// The units, and which of them are there already.
  Status list_units() {
    for (const Row& row : experiment_.rows) {
      for (std::size_t i = 0; i < config_.worlds.size(); ++i) {
        Unit unit{&row, i, {}, false};
        unit.file =
            config_.out / "units" / fmt::format("{}.world_{}.csv", row.id, config_.worlds[i]);
        unit.finished = std::filesystem::exists(unit.file);
        if (unit.finished) {
          if (!config_.resume) {
            return fail(Error{ErrorCode::kFailedPrecondition,
                              fmt::format("{}: holds results already", config_.out.string()),
                              "--out",
                              "go on with --resume, or choose another --out"});
          }
          if (const auto rows = rows_of_unit(unit); !rows) return fail(rows.error());
        }
        units_.push_back(std::move(unit));
      }
    }
    std::error_code ignored;
    std::filesystem::create_directories(config_.out / "units", ignored);
    return io::write_text_file(config_.out / "settings.txt", describe(config_));
  }

  Result<std::string> rows_of_unit(const Unit& unit) const {
    return read_unit(unit.file, first_line_of(config_, *unit.row), csv_header(), check_trials);
  }

  void make_worlds() {
    experiment_.worlds.resize(config_.worlds.size());
    pool_.parallel_for(config_.worlds.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        experiment_.worlds[i] = make_world(config_.world, WorldSeeds::all(config_.worlds[i]));
      }
    });
  }

  /// The unfinished units' plans, each once, before threads share them.
  Status draw_plans() {
    settings_.plans = config_.out / "plans";
    std::set<std::filesystem::path> drawn;
    for (const Unit& unit : units_) {
      if (unit.finished) continue;
      SEMVIEW_TRY(const std::vector<Method> methods, methods_of(config_, *unit.row));
      for (const Method& method : methods) {
        const std::uint64_t seed = config_.worlds[unit.world];
        const ClassSubset classes = unit.row->classes;
        if (!drawn.insert(plan_directory(settings_.plans, seed, classes, method.stacked_plan))
                 .second) {
          continue;
        }
        SEMVIEW_TRY_STATUS(draw_world_plan(experiment_.worlds[unit.world].layout,
                                           seed,
                                           classes,
                                           method.stacked_plan,
                                           settings_.plans));
      }
    }
    return {};
  }

  Status prepare_weights() {
    SEMVIEW_TRY(settings_.hand,
                similarity::parse_weight_matrix(kHandMatrix, "the built-in matrix"));
    settings_.starts = config_.starts;
    settings_.runs = config_.runs;
    settings_.seed = config_.seed;
    settings_.engine = config_.engine;
    std::map<ClassSubset, std::set<int>> kinds;
    for (const Unit& unit : units_) {
      if (unit.finished) continue;
      SEMVIEW_TRY(const std::vector<Method> methods, methods_of(config_, *unit.row));
      for (const Method& method : methods) {
        if (method.weights == WeightsKind::kLearned) kinds[unit.row->classes].insert(method.bands);
      }
    }
    if (kinds.empty()) return {};
    SEMVIEW_TRY(settings_.learned,
                learn_weights(make_training_worlds(config_.world, pool_),
                              kinds,
                              settings_.plans,
                              config_.engine,
                              pool_));
    for (const auto& [kind, matrix] : settings_.learned) {
      const auto& [classes, bands] = kind;
      const std::string file = bands == Method().bands
                                   ? fmt::format("weights_{}.csv", name(classes))
                                   : fmt::format("weights_{}_{}_bands.csv", name(classes), bands);
      SEMVIEW_TRY_STATUS(io::write_text_file(config_.out / file, matrix.to_csv()));
    }
    return {};
  }

  Status run_units() {
    const TimePoint began = steady_clock().now();
    std::mutex mutex;
    Status first_error;
    std::atomic<bool> failed = false;
    const auto finished =
        static_cast<std::size_t>(std::ranges::count(units_, true, &Unit::finished));
    std::size_t done = finished;
    experiment_.units = units_.size();
    experiment_.kept_units = finished;
    pool_.parallel_for(units_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (units_[i].finished || failed) continue;
        Status status = run_one(units_[i]);
        const std::lock_guard lock(mutex);
        if (!status) {
          if (!failed) first_error = std::move(status);
          failed = true;
          continue;
        }
        ++done;
        const std::chrono::duration<double> taken = steady_clock().now() - began;
        const double a_unit_s = taken.count() / static_cast<double>(done - finished);
        progress_({done, units_.size(), a_unit_s * static_cast<double>(units_.size() - done)});
      }
    });
    return first_error;
  }

  Status run_one(const Unit& unit) const {
    SEMVIEW_TRY(const std::vector<Method> methods, methods_of(config_, *unit.row));
    SEMVIEW_TRY(const std::vector<TrialRecord> drives,
                run_unit(settings_,
                         methods,
                         *unit.row,
                         experiment_.worlds[unit.world],
                         config_.worlds[unit.world]));
    std::string times = times_csv_header();
    for (const TrialRecord& drive : drives) times += times_csv(drive);
    // The results last: where they are, the unit is finished.
    std::filesystem::path times_file = unit.file;
    SEMVIEW_TRY_STATUS(io::write_text_file(times_file.replace_extension(".times.csv"), times));
    std::string csv = csv_header();
    for (const TrialRecord& drive : drives) csv += to_csv(drive);
    return io::write_text_file(unit.file, unit_text(csv, first_line_of(config_, *unit.row)));
  }

  /// From the files, finished now or earlier: tables cannot differ from what is stored.
  Status collect() {
    std::string all = first_line(config_) + csv_header();
    for (const Unit& unit : units_) {
      SEMVIEW_TRY(const std::string rows, rows_of_unit(unit));
      all += rows;
      SEMVIEW_TRY(std::vector<TrialRecord> trials, parse_trials(rows, unit.file.string()));
      for (TrialRecord& trial : trials) experiment_.trials.push_back(std::move(trial));
    }
    return io::write_text_file(config_.out / "runs.csv", all);
  }

  Experiment& experiment_;
  const ExperimentConfig& config_;
  const std::function<void(const ExperimentProgress&)>& progress_;
  ThreadPool pool_;
  std::vector<Unit> units_;
  UnitSettings settings_;
};

}  // namespace

Result<std::vector<Row>> rows_of(const ExperimentConfig& config) { return rows_by_id(config.rows); }

Status validate(const ExperimentConfig& config) {
  const auto refuse = [](const char* option, std::string message) {
    return fail(Error{ErrorCode::kInvalidArgument, std::move(message), option});
  };
  if (config.runs < 1 || config.runs > 1000) {
    return refuse("--runs", fmt::format("--runs {}: expected 1 to 1000", config.runs));
  }
  SEMVIEW_TRY_STATUS(check_starts(config.starts));
  SEMVIEW_TRY_STATUS(check_each_once("--rows", config.rows));
  if (config.out.empty()) return refuse("--out", "--out: expected a folder");
  if (const auto rows = rows_of(config); !rows) return fail(rows.error());
  if (const auto methods = methods_by_id(config.methods); !methods) return fail(methods.error());
  if (const auto use = check_worlds(config.worlds); !use) return fail(use.error());
  return service::validate(site_config(config.engine));
}

std::string describe(const ExperimentConfig& config) {
  std::string text = fmt::format(
      "format: 2\nengine: {}\nruns: {}, seed {}\nstarts:", config.engine, config.runs, config.seed);
  for (const Start start : config.starts) text += fmt::format(" {}", name(start));
  text += '\n' + describe(config.world);
  std::vector<std::string> ids = config.methods;
  if (ids.empty()) ids = default_methods(*find_row("unmodified"));
  if (const auto methods = methods_by_id(ids)) {
    for (const Method& method : *methods) text += describe(method) + '\n';
  }
  return text;
}

Result<Experiment> run_experiment(const ExperimentConfig& config,
                                  const std::function<void(const ExperimentProgress&)>& progress) {
  SEMVIEW_TRY_STATUS(validate(config));
  SEMVIEW_TRY_STATUS(io::check_output_folder(config.out));
  Experiment experiment;
  experiment.config = config;
  SEMVIEW_TRY(experiment.use, check_worlds(config.worlds));
  SEMVIEW_TRY(experiment.rows, rows_of(config));
  SEMVIEW_TRY_STATUS(Runner(experiment, progress).run());
  return experiment;
}

}  // namespace semview::paper2017
