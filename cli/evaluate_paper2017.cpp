// SPDX-License-Identifier: Apache-2.0
/// `semview evaluate paper2017`.
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "estimates_option.hpp"
#include "evaluate_verbs.hpp"
#include "experiments/paper2017/experiment.hpp"
#include "experiments/paper2017/foreign_estimates.hpp"
#include "experiments/paper2017/report.hpp"
#include "experiments/paper2017/report_files.hpp"
#include "experiments/paper2017/results.hpp"
#include "experiments/paper2017/revision.hpp"
#include "experiments/paper2017/world_export.hpp"
#include "semview/core/clock.hpp"
#include "semview/io/text_file.hpp"
#include "site_options.hpp"
#include "starts_option.hpp"
#include "stop_signals.hpp"
#include "summary_json.hpp"
#include "threads_option.hpp"
#include "verb.hpp"
#include "world_list.hpp"

namespace semview::cli {
namespace {

struct Options {
  paper2017::ExperimentConfig experiment;
  std::string worlds;
  std::vector<std::string> starts;
  std::string out = "paper2017_results";
  bool quick = false;
  bool json = false;
  std::string export_to;
  std::vector<std::string> estimates;
};

void show_progress(const paper2017::ExperimentProgress& progress) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  fmt::print(stderr,
             "{}[{}/{}] about {:.0f} s left{}",
             terminal ? "\r\033[K" : "",
             progress.done,
             progress.units,
             progress.remaining_s,
             terminal && progress.done < progress.units ? "" : "\n");
}

Result<paper2017::ExperimentConfig> config_of(const CLI::App& verb, const Options& options) {
  paper2017::ExperimentConfig config = options.experiment;
  config.out = options.out;
  if (options.quick) {
    if (verb.count("--rows") == 0)
      config.rows = {"unmodified", "scale_1.2", "scale_1.4", "shear_0.5"};
    if (verb.count("--worlds") == 0) config.worlds = {1, 2, 3};
    if (verb.count("--runs") == 0) config.runs = 3;
    if (verb.count("--starts") == 0) config.starts = {paper2017::Start::kLocal};
  }
  if (verb.count("--worlds") > 0) {
    SEMVIEW_TRY(config.worlds, parse_worlds(options.worlds));
  }
  if (verb.count("--starts") > 0) {
    SEMVIEW_TRY(config.starts, parse_starts(options.starts));
  }
  return config;
}

/// The command that gives the same results again.
std::string command_of(const paper2017::ExperimentConfig& config) {
  std::string command = "semview evaluate paper2017";
  const auto list = [&](const char* option, const std::vector<std::string>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      command += (i == 0 ? fmt::format(" {} ", option) : ",") + values[i];
    }
  };
  list("--rows", config.rows);
  command += fmt::format(" --worlds {} --runs {} --seed {} --engine {}",
                         world_list(config.worlds),
                         config.runs,
                         config.seed,
                         config.engine);
  list("--methods", config.methods);
  std::vector<std::string> starts;
  for (const paper2017::Start start : config.starts) starts.emplace_back(paper2017::name(start));
  list("--starts", starts);
  return command;
}

/// An export holds rows on worlds, whatever would be run on them.
Status check_only_exports(const CLI::App& verb) {
  for (const char* option :
       {"--runs", "--seed", "--methods", "--starts", "--resume", "--out", "--json"}) {
    if (verb.count(option) == 0) continue;
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("{}: has no meaning with --export, which runs nothing; expected "
                                  "--rows, --worlds, --engine, --threads or --quick",
                                  option),
                      option});
  }
  return {};
}

Status write_worlds(const paper2017::ExperimentConfig& config, const std::string& directory) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  SEMVIEW_TRY_STATUS(
      paper2017::export_worlds(config, directory, [terminal](std::size_t done, std::size_t all) {
        if (terminal) fmt::print(stderr, "\r\033[K[{}/{}]{}", done, all, done < all ? "" : "\n");
      }));
  fmt::print(
      "{0}/input: maps and run logs, listed in list.csv\n"
      "{0}/truth: where the robot was\n"
      "Trajectories come back with --estimates NAME=DIR, under the names in column estimate.\n",
      directory);
  return {};
}

/// All that was given, read before hours go into the methods of ours.
Result<std::vector<paper2017::ForeignMethod>> read_foreign(
    const Options& options, const paper2017::ExperimentConfig& config) {
  SEMVIEW_TRY(const std::vector<NamedFolder> folders, parse_estimates(options.estimates));
  std::vector<paper2017::ForeignMethod> methods;
  for (const NamedFolder& folder : folders) {
    SEMVIEW_TRY(paper2017::ForeignMethod method,
                paper2017::read_estimates({folder.name, folder.directory}, config));
    methods.push_back(std::move(method));
  }
  return methods;
}

/// `estimates.csv`, beside `runs.csv` and with its columns.
Status write_foreign(const paper2017::Experiment& experiment, std::size_t first_foreign) {
  std::string text = paper2017::csv_header();
  for (std::size_t i = first_foreign; i < experiment.trials.size(); ++i) {
    text += paper2017::to_csv(experiment.trials[i]);
  }
  return io::write_text_file(experiment.config.out / "estimates.csv", text);
}

Status run(const CLI::App& verb, const Options& options) {
  SEMVIEW_TRY(const paper2017::ExperimentConfig config, config_of(verb, options));
  if (!options.export_to.empty()) {
    SEMVIEW_TRY_STATUS(check_only_exports(verb));
    return write_worlds(config, options.export_to);
  }
  SEMVIEW_TRY(const std::vector<paper2017::ForeignMethod> foreign, read_foreign(options, config));
  say_when_stopped(fmt::format(
      "stopped; rows on worlds that were done are kept in {}/units: go on with --resume",
      options.out));
  const TimePoint began = steady_clock().now();
  SEMVIEW_TRY(paper2017::Experiment experiment, paper2017::run_experiment(config, show_progress));
  const std::chrono::duration<double> taken = steady_clock().now() - began;
  const std::size_t ours = experiment.trials.size();
  for (const paper2017::ForeignMethod& method : foreign) paper2017::add_drives(method, experiment);
  if (!foreign.empty()) SEMVIEW_TRY_STATUS(write_foreign(experiment, ours));
  const paper2017::Results results(experiment);
  paper2017::ReportHeader header;
  header.command = command_of(config);
  header.revision = paper2017::kRevision;
  header.cpu = paper2017::cpu_name();
  header.threads = config.threads > 0 ? config.threads : std::thread::hardware_concurrency();
  header.wall_s = taken.count();
  SEMVIEW_TRY(const std::string page, paper2017::write_report(results, header, config.out));
  if (options.json) {
    const nlohmann::ordered_json json{{"command", header.command},
                                      {"commit", header.revision},
                                      {"rows", summaries_json(results, "row")}};
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("{}", page);
  }
  return {};
}

}  // namespace

void add_evaluate_paper2017_verb(CLI::App& evaluate, int& exit_code) {
  CLI::App* verb = evaluate.add_subcommand(
      "paper2017",
      "The experiments of Neubert, Schubert, Protzel 2017 on generated worlds: the rows of Fig. 3, "
      "identity and weighted matrices as printed, ours, and odometry. Prints the tables and leaves "
      "them with pictures and a CSV line a run and stop in a folder. See "
      "experiments/paper2017/README.md.");
  const auto options = std::make_shared<Options>();
  verb->add_option("--rows", options->experiment.rows, "Rows of Fig. 3; default: all")
      ->type_name("ROW,...")
      ->delimiter(',');
  verb->add_option("--worlds",
                   options->worlds,
                   "World seeds: 1..100 for results, 201..205 for choosing settings; default: 1..6")
      ->type_name("A..B,C,...");
  verb->add_option("--runs", options->experiment.runs, "Filter seeds a world")
      ->capture_default_str();
  verb->add_option("--seed", options->experiment.seed, "Seed of the filters")
      ->capture_default_str();
  add_threads_option(*verb, options->experiment.threads);
  verb->add_option("--methods",
                   options->experiment.methods,
                   "Methods; \"ablation\": ours, and ours without one idea each; default: "
                   "identity,weighted,ours")
      ->type_name("METHOD,...")
      ->delimiter(',');
  add_starts_option(*verb, options->starts, "both");
  add_engine_option(*verb, options->experiment.engine);
  verb->add_flag("--resume", options->experiment.resume, "Keep what is finished in --out");
  verb->add_option("--out", options->out, "Folder of the results")->capture_default_str();
  verb->add_flag("--quick",
                 options->quick,
                 "Four rows, 3 worlds, 3 runs, known start, in about two minutes; --rows, "
                 "--worlds, --runs and "
                 "--starts win over it");
  verb->add_flag("--json", options->json, "Print a line a row, start and method as JSON");
  auto* estimates = add_estimates_option(*verb,
                                         options->estimates,
                                         "Add the trajectories of another program as a column: "
                                         "DIR/ROW/world_W.tum, as list.csv of --export names them");
  verb->add_option("--export",
                   options->export_to,
                   "Run nothing: write the rows and worlds as map bundles and run logs, and apart "
                   "from them where the robot was; takes --rows, --worlds and --quick")
      ->type_name("DIR")
      ->excludes(estimates);
  verb->footer("Example: semview evaluate paper2017 --quick --out quick");
  verb->callback([verb, options, &exit_code] { exit_code = report(run(*verb, *options)); });
}

}  // namespace semview::cli
