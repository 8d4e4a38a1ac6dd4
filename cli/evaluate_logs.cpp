// SPDX-License-Identifier: Apache-2.0
/// `semview evaluate logs`.
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "estimates_option.hpp"
#include "evaluate_verbs.hpp"
#include "experiments/paper2017/report.hpp"
#include "experiments/paper2017/revision.hpp"
#include "experiments/paper2017/summary.hpp"
#include "experiments/paper2017/tables.hpp"
#include "learned_from.hpp"
#include "map_weights.hpp"
#include "recordings.hpp"
#include "semview/core/clock.hpp"
#include "semview/core/log.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/io/output_path.hpp"
#include "semview/io/text_file.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/service/shipped_weights.hpp"
#include "site_options.hpp"
#include "starts_option.hpp"
#include "stop_signals.hpp"
#include "summary_json.hpp"
#include "verb.hpp"
#include "waiting_line.hpp"
#include "weights_option.hpp"

namespace semview::cli {
namespace {

using paper2017::Experiment;
using paper2017::Start;

struct Options {
  std::string map;
  std::vector<std::string> logs;
  SiteOptions site;
  std::string weights;
  std::string learned;
  std::string segment;
  paper2017::RecordingsConfig config;
  std::vector<std::string> starts;
  std::vector<std::string> estimates;
  std::string out;
  bool json = false;
};

Result<paper2017::RecordingWeights> weights_of(const Options& options,
                                               const ClassTable& observed,
                                               const map::SemanticMap& map) {
  SEMVIEW_TRY(const std::string shipped, service::shipped_weights_csv(map.directory));
  SEMVIEW_TRY(ChosenWeights hand,
              choose_weights(options.weights, options.map, shipped, observed, map.classes));
  std::optional<similarity::WeightMatrix> learned;
  if (!options.learned.empty()) {
    SEMVIEW_TRY_STATUS(check_not_learned_from(options.learned, options.logs));
    SEMVIEW_TRY(learned, read_weights(options.learned, observed, map.classes));
    Status fits = learned->check(observed, map.classes);
    if (!fits) return with_context(std::move(fits), options.learned);
  }
  return paper2017::RecordingWeights{
      paper2017::identity_of(hand.matrix), std::move(hand.matrix), std::move(learned)};
}

Result<Experiment> evaluate(const Options& options, const paper2017::RecordingsConfig& config) {
  SiteOptions site_options = options.site;
  site_options.map = options.map;
  SEMVIEW_TRY(const std::shared_ptr<service::Site> site, open_site(site_options));
  SEMVIEW_TRY(const ReadRecordings read, read_recordings(options.logs, options.segment, *site));
  for (const std::string& note : read.notes) log_warning(note);
  // Foreign files first: a slip in them shall not cost a run.
  SEMVIEW_TRY(const std::vector<NamedFolder> folders, parse_estimates(options.estimates));
  std::vector<paper2017::TrialRecord> foreign;
  for (const NamedFolder& folder : folders) {
    SEMVIEW_TRY(const std::vector<paper2017::TrialRecord> trials,
                paper2017::read_recording_estimates(
                    {folder.name, folder.directory}, read.recordings, config.starts.front()));
    foreign.insert(foreign.end(), trials.begin(), trials.end());
  }
  SEMVIEW_TRY(const paper2017::RecordingWeights weights,
              weights_of(options, read.observed, site->map()));
  WaitingLine line = waiting_for_views(options.site.cache_directory);
  say_when_stopped("stopped; of drives that were done nothing is kept");
  SEMVIEW_TRY(Experiment experiment,
              paper2017::run_recordings(config,
                                        read.recordings,
                                        weights,
                                        site->views(),
                                        site->pool(),
                                        [&line](std::size_t done, std::size_t drives) {
                                          line.show(done, drives, "drives");
                                        }));
  paper2017::add_trials(foreign, experiment);
  return experiment;
}

std::string tables(const paper2017::Results& results, bool each_image) {
  std::string text;
  const auto section = [&](const std::string& title, const std::string& table) {
    if (!table.empty()) text += fmt::format("\n## {}\n\n{}", title, table);
  };
  for (const Start start : results.experiment().config.starts) {
    const std::string_view how = paper2017::name(start);
    section(fmt::format("Mean error in m, {} localization", how),
            paper2017::fig3_table(results, start));
    section(fmt::format("Mean errors in m, shares, images until the error stays below {:g} m, {} "
                        "localization",
                        paper2017::kLocalizedWithin_m,
                        how),
            paper2017::summary_table(results, start));
    section(fmt::format("Spread of the estimates' errors, {} localization", how),
            paper2017::spread_table(results, start));
    section(fmt::format("One idea off or on at a time, {} localization", how),
            paper2017::ablation_table(results, start));
    if (each_image) {
      section(fmt::format("Mean error in m at each image, {} localization", how),
              paper2017::image_table(results, start));
    }
  }
  return text;
}

/// What the tables hang on, in a line.
std::string settings_of(const Options& options, const Experiment& experiment) {
  return fmt::format(
      "{} on {}: {} run{} each, seed {}; weights {}, likelihood ratios {}; commit {}.\n",
      fmt::join(options.logs, " "),
      options.map,
      experiment.config.runs,
      experiment.config.runs == 1 ? "" : "s",
      experiment.config.seed,
      options.weights.empty() ? "of the map" : options.weights,
      options.learned.empty() ? "none (methods that learn take the weights)" : options.learned,
      paper2017::kRevision);
}

/// `runs.csv` of equal bytes for any number of threads, and a page with what made it.
Status write_results(const Options& options, const paper2017::Results& results, double wall_s) {
  const Experiment& experiment = results.experiment();
  std::string csv = paper2017::csv_header();
  for (const paper2017::TrialRecord& trial : experiment.trials) {
    if (trial.row != paper2017::kAllRecordings) csv += paper2017::to_csv(trial);
  }
  const std::filesystem::path out = options.out;
  SEMVIEW_TRY_STATUS(io::write_text_file(out / "runs.csv", csv));
  std::string page = fmt::format("# {}\n\n{}{}, {:.0f} s.\n",
                                 options.map,
                                 settings_of(options, experiment),
                                 paper2017::cpu_name(),
                                 wall_s);
  page += tables(results, true);
  return io::write_text_file(out / "report.md", page);
}

/// Tables of other settings are not written over: nobody could tell which they are of.
Status check_holds_no_results(const std::filesystem::path& out) {
  SEMVIEW_TRY_STATUS(io::check_output_folder(out));
  for (const char* file : {"runs.csv", "report.md"}) {
    if (!std::filesystem::exists(out / file)) continue;
    return fail(Error{ErrorCode::kFailedPrecondition,
                      fmt::format("{}: holds results already ({})", out.string(), file),
                      "--out",
                      "choose another --out, or take the old results away"});
  }
  return {};
}

Status run(const Options& options) {
  paper2017::RecordingsConfig config = options.config;
  if (!options.starts.empty()) {
    SEMVIEW_TRY(config.starts, parse_starts(options.starts));
  }
  SEMVIEW_TRY_STATUS(paper2017::validate(config));
  if (!options.out.empty()) SEMVIEW_TRY_STATUS(check_holds_no_results(options.out));
  const TimePoint began = steady_clock().now();
  SEMVIEW_TRY(const Experiment experiment, evaluate(options, config));
  const std::chrono::duration<double> taken = steady_clock().now() - began;
  const paper2017::Results results(experiment);
  if (!options.out.empty()) {
    std::error_code ignored;
    std::filesystem::create_directories(options.out, ignored);
    SEMVIEW_TRY_STATUS(write_results(options, results, taken.count()));
  }
  if (options.json) {
    const nlohmann::ordered_json json{{"map", options.map},
                                      {"rows", summaries_json(results, "log")}};
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("{}{}", settings_of(options, experiment), tables(results, false));
  }
  return {};
}

}  // namespace

void add_evaluate_logs_verb(CLI::App& evaluate_verb, int& exit_code) {
  CLI::App* verb = evaluate_verb.add_subcommand(
      "logs",
      "The tables of `evaluate paper2017` for anybody's recordings: run logs with ground truth, "
      "the "
      "methods of the 2017 paper, ours, and odometry, over several filter seeds. A known start is "
      "the ground truth's pose at the first frame.");
  const auto options = std::make_shared<Options>();
  verb->add_option("--map", options->map, "Map folder, map.yaml, .glb or .vdb")
      ->type_name("MAP")
      ->required();
  verb->add_option("LOG", options->logs, "Folders of run logs")->required();
  verb->add_option("--methods",
                   options->config.methods,
                   "Methods as of `evaluate paper2017`; odometry has a column always")
      ->type_name("METHOD,...")
      ->delimiter(',')
      ->allow_extra_args(false)  // what follows are logs
      ->capture_default_str();
  add_starts_option(*verb, options->starts, "local");
  verb->add_option("--runs", options->config.runs, "Filter seeds a log")->capture_default_str();
  verb->add_option("--seed", options->config.seed, "Seed of the filters")->capture_default_str();
  add_weights_option(*verb, options->weights)
      ->description(
          "Weight matrix of `weighted`; `identity` is 1 where it has a class's full match "
          "(default: "
          "the map's own weights.csv, else equal names)");
  verb->add_option(
          "--learned",
          options->learned,
          "Likelihood ratios of `semview weights learn` for methods that learn, as `ours`; "
          "without them they use --weights")
      ->type_name("FILE.csv");
  verb->add_option("--segment", options->segment, "Label the logs' images with this network")
      ->type_name("MODEL");
  add_estimates_option(*verb,
                       options->estimates,
                       "Add the trajectories of another program as a column: DIR/LOG.tum, named as "
                       "the logs' folders are");
  verb->add_option("--out", options->out, "Folder for runs.csv (a line a run and stop), report.md")
      ->type_name("DIR");
  verb->add_flag("--json", options->json, "Print JSON");
  add_site_options(*verb, options->site, false);
  verb->remove_option(verb->get_option("map"));  // named by --map; logs are what is listed
  verb->footer(
      "Example: semview evaluate logs --map maps/duplex_level1 run1 run2 --runs 5 --out compared");
  verb->callback([options, &exit_code] { exit_code = report(run(*options)); });
}

}  // namespace semview::cli
