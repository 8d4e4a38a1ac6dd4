// SPDX-License-Identifier: Apache-2.0
/// `semview evaluate paper2023`.
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "evaluate_verbs.hpp"
#include "experiments/paper2017/revision.hpp"
#include "experiments/paper2023/experiment.hpp"
#include "experiments/paper2023/recording_export.hpp"
#include "experiments/paper2023/report.hpp"
#include "semview/core/clock.hpp"
#include "semview/io/output_path.hpp"
#include "threads_option.hpp"
#include "verb.hpp"
#include "world_list.hpp"

namespace semview::cli {
namespace {

struct Options {
  paper2023::ExperimentConfig experiment;
  std::string worlds;
  std::string out = "paper2023_results";
  bool quick = false;
  std::string export_to;
};

void show_progress(std::size_t done, std::size_t all) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  fmt::print(stderr,
             "{}[{}/{}]{}",
             terminal ? "\r\033[K" : "",
             done,
             all,
             terminal && done < all ? "" : "\n");
}

Result<paper2023::ExperimentConfig> config_of(const CLI::App& verb, const Options& options) {
  paper2023::ExperimentConfig config = options.experiment;
  if (options.quick) {
    config.worlds = {1, 2};
    config.static_runs = 2;
    config.changed_paths = 2;
    config.changed_runs = 1;
  }
  if (verb.count("--worlds") > 0) {
    SEMVIEW_TRY(config.worlds, parse_worlds(options.worlds));
  }
  return config;
}

/// The command that gives the same results again.
std::string command_of(const paper2023::ExperimentConfig& config, bool quick) {
  std::string command =
      fmt::format("semview evaluate paper2023{} --worlds {} --particles {} --seed {}",
                  quick ? " --quick" : "",
                  world_list(config.worlds),
                  config.filter.particles,
                  config.seed);
  for (std::size_t i = 0; i < config.methods.size(); ++i) {
    command += (i == 0 ? " --methods " : ",") + config.methods[i];
  }
  return command;
}

Status write_recordings(const paper2023::ExperimentConfig& config, const std::string& directory) {
  paper2023::ExportConfig recordings;
  recordings.worlds = config.worlds;
  recordings.static_paths = config.static_paths;
  recordings.changed_paths = config.changed_paths;
  recordings.threads = config.threads;
  recordings.world = config.world;
  SEMVIEW_TRY_STATUS(paper2023::export_recordings(recordings, directory, show_progress));
  fmt::print(
      "{0}/input: run logs, listed in list.csv; of each world one to map and others to localize "
      "on\n"
      "{0}/truth: where the robot was\n",
      directory);
  return {};
}

Status run(const CLI::App& verb, const Options& options) {
  SEMVIEW_TRY(const paper2023::ExperimentConfig config, config_of(verb, options));
  if (!options.export_to.empty()) return write_recordings(config, options.export_to);
  SEMVIEW_TRY_STATUS(io::check_output_folder(options.out));
  const TimePoint began = steady_clock().now();
  SEMVIEW_TRY(const paper2023::Experiment experiment,
              paper2023::run_experiment(config, show_progress));
  const std::chrono::duration<double> taken = steady_clock().now() - began;
  paper2017::ReportHeader header;
  header.command = command_of(config, options.quick);
  header.revision = paper2017::kRevision;
  header.cpu = paper2017::cpu_name();
  header.threads = config.threads > 0 ? config.threads : std::thread::hardware_concurrency();
  header.wall_s = taken.count();
  SEMVIEW_TRY(const std::string page, paper2023::write_report(experiment, header, options.out));
  fmt::print("{}", page);
  return {};
}

}  // namespace

void add_evaluate_paper2023_verb(CLI::App& evaluate, int& exit_code) {
  CLI::App* verb = evaluate.add_subcommand(
      "paper2023",
      "The experiments of Gomez et al. 2023 on generated flats: each is mapped with a depth camera "
      "and localized in, as it was and after things were moved, taken away and replaced. Prints "
      "Tables 1 and 2 beside the paper's and leaves them with pictures and a CSV line a run and "
      "image in a folder. See experiments/paper2023/README.md.");
  const auto options = std::make_shared<Options>();
  verb->add_option("--worlds",
                   options->worlds,
                   "Seeds of flats: 1..100 for results, 201..205 for choosing settings; default: "
                   "1..6")
      ->type_name("A..B,C,...");
  verb->add_option(
          "--methods",
          options->experiment.methods,
          "Some of sdf,sem_gt,sem_rcnn,sdf_sem_gt,sdf_sem_rcnn as printed, ours_gt,ours_rcnn, and "
          "of these with an idea off, _no_outliers, _no_sigma or _no_motion behind the name; "
          "default: all but the last")
      ->type_name("METHOD,...")
      ->delimiter(',');
  verb->add_option("--particles", options->experiment.filter.particles, "Particles of the filter")
      ->capture_default_str();
  verb->add_option("--seed", options->experiment.seed, "Seed of the filters")
      ->capture_default_str();
  add_threads_option(*verb, options->experiment.threads);
  auto* out =
      verb->add_option("--out", options->out, "Folder of the results")->capture_default_str();
  verb->add_flag("--quick", options->quick, "2 flats, fewer paths and runs, in some two minutes");
  verb->add_option("--export",
                   options->export_to,
                   "Run nothing: write what the robot records as run logs and, apart from them, "
                   "where it was")
      ->type_name("DIR")
      ->excludes(out);
  verb->footer("Example: semview evaluate paper2023 --quick --out quick");
  verb->callback([verb, options, &exit_code] { exit_code = report(run(*verb, *options)); });
}

}  // namespace semview::cli
