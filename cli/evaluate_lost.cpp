// SPDX-License-Identifier: Apache-2.0
/// `semview evaluate lost`.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "evaluate_verbs.hpp"
#include "experiments/paper2017/guard.hpp"
#include "experiments/paper2017/hand_matrix.hpp"
#include "experiments/paper2017/lost_calibration.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/io/text_file.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "threads_option.hpp"
#include "verb.hpp"
#include "world_list.hpp"

namespace semview::cli {
namespace {

using nlohmann::ordered_json;
using paper2017::LostQuality;
using paper2017::LostStop;

const std::vector<std::uint64_t> kTrainingWorlds{101, 102, 103, 104, 105, 106};
const std::vector<double> kTrainingNoise{0.2, 0.3, 0.5};
constexpr double kMostNoise = 3.0;

struct Options {
  std::string worlds = "1..6";
  std::vector<double> noise{0.3, 0.7};
  int runs = 2;
  std::uint64_t seed = 1;
  std::size_t threads = 0;
  bool learn = false;
  std::string out = "lost_results";
  bool json = false;
};

void print_model(const observation::LostModel& model) {
  fmt::print("model: {{{:.4f}, {{{:.4f}, {:.4f}, {:.4f}, {:.4f}, {:.4f}}}}}\n",
             model.intercept,
             model.weights[0],
             model.weights[1],
             model.weights[2],
             model.weights[3],
             model.weights[4]);
}

double per_200(std::size_t count, std::size_t of) {
  return of == 0 ? 0.0 : 200.0 * static_cast<double>(count) / static_cast<double>(of);
}

void print_quality(const std::string& title, const LostQuality& quality) {
  fmt::print(
      "{}: {} stops, {} lost; calibration error {:.3f}; kidnapped robots flagged within two "
      "observations {} of {}; false alarms {} in {} stops ({:.2f} in 200)\n",
      title,
      quality.stops,
      quality.lost,
      quality.calibration_error,
      quality.flagged,
      quality.kidnaps,
      quality.false_alarms,
      quality.good,
      per_200(quality.false_alarms, quality.good));
  for (const paper2017::ReliabilityBin& bin : quality.bins) {
    if (bin.stops == 0) continue;
    fmt::print("  probability {:.3f}  lost {:.3f}  {} stops\n",
               bin.mean_probability,
               bin.lost_share,
               bin.stops);
  }
}

ordered_json as_json(const LostQuality& quality) {
  ordered_json bins = ordered_json::array();
  for (const paper2017::ReliabilityBin& bin : quality.bins) {
    if (bin.stops == 0) continue;
    bins.push_back({{"mean_probability", bin.mean_probability},
                    {"lost_share", bin.lost_share},
                    {"stops", bin.stops}});
  }
  return {{"stops", quality.stops},
          {"lost", quality.lost},
          {"calibration_error", quality.calibration_error},
          {"kidnaps", quality.kidnaps},
          {"flagged_within_two", quality.flagged},
          {"false_alarms", quality.false_alarms},
          {"good_stops", quality.good},
          {"reliability", std::move(bins)}};
}

/// Training worlds teach, all others judge: a world that did both would judge itself.
Result<std::vector<std::uint64_t>> worlds_of(const Options& options) {
  if (options.learn) return kTrainingWorlds;
  SEMVIEW_TRY(std::vector<std::uint64_t> worlds, parse_worlds(options.worlds));
  if (const auto use = paper2017::check_worlds(worlds); !use) return fail(use.error());
  return worlds;
}

Status check_noise(const std::vector<double>& levels) {
  for (const double level : levels) {
    if (level >= 0.0 && level <= kMostNoise && std::ranges::count(levels, level) == 1) continue;
    return fail(Error{
        ErrorCode::kInvalidArgument,
        fmt::format("--noise {:g}: expected levels from 0 to {:g}, each once", level, kMostNoise),
        "--noise"});
  }
  return {};
}

void print_json(const observation::LostModel& model, ordered_json all, ordered_json levels) {
  const ordered_json json{{"model", {{"intercept", model.intercept}, {"weights", model.weights}}},
                          {"all", std::move(all)},
                          {"levels", std::move(levels)}};
  fmt::print("{}\n", json.dump(2));
}

Status evaluate_lost(const Options& options) {
  SEMVIEW_TRY_STATUS(check_noise(options.noise));
  SEMVIEW_TRY(std::vector<std::uint64_t> worlds, worlds_of(options));
  SEMVIEW_TRY(similarity::WeightMatrix weights,
              similarity::parse_weight_matrix(std::string(paper2017::kHandMatrix),
                                              "paper2017_ade20k150.csv"));
  const std::filesystem::path out(options.out);
  std::error_code failed;  // writing into it tells
  std::filesystem::create_directories(out, failed);
  paper2017::LostSettings settings{std::move(worlds),
                                   options.learn ? kTrainingNoise : options.noise,
                                   options.runs,
                                   options.seed,
                                   out / "plans",
                                   std::move(weights)};
  ThreadPool pool(options.threads);
  SEMVIEW_TRY(const std::vector<LostStop> stops, paper2017::drive_all(settings, pool));
  const observation::LostModel model =
      options.learn ? paper2017::fit_lost_model(stops) : observation::learned_lost_model();
  ordered_json levels = ordered_json::array();
  if (options.learn && !options.json) print_model(model);
  for (const double level : settings.noise_levels) {
    std::vector<LostStop> of_level;
    std::ranges::copy_if(stops, std::back_inserter(of_level), [level](const LostStop& stop) {
      return stop.noise_level == level;
    });
    const LostQuality quality = paper2017::measure_quality(of_level, model);
    levels.push_back({{"noise", level}});
    levels.back().update(as_json(quality));
    if (!options.json) print_quality(fmt::format("noise {:g}", level), quality);
  }
  const LostQuality all = paper2017::measure_quality(stops, model);
  if (!options.json) print_quality("all", all);
  SEMVIEW_TRY_STATUS(
      io::write_text_file(out / "lost_stops.csv", paper2017::lost_stops_csv(stops, model)));
  SEMVIEW_TRY_STATUS(io::write_text_file(
      out / "reliability.svg",
      paper2017::reliability_svg(all, options.learn ? "training worlds" : "Am I lost?")));
  if (options.json) print_json(model, as_json(all), std::move(levels));
  return {};
}

}  // namespace

void add_evaluate_lost_verb(CLI::App& evaluate, int& exit_code) {
  CLI::App* verb = evaluate.add_subcommand(
      "lost",
      "How far `lost_probability` can be believed: drives through generated worlds with known, "
      "wrong and unknown starts and kidnapped robots. Prints calibration error, alarms and false "
      "alarms; writes lost_stops.csv and reliability.svg.");
  const auto options = std::make_shared<Options>();
  auto* worlds = verb->add_option("--worlds",
                                  options->worlds,
                                  "World seeds: 1..100 for results, 201..205 for choosing settings")
                     ->type_name("A..B,C,...")
                     ->capture_default_str();
  verb->add_option("--noise", options->noise, "Levels of segmentation noise")
      ->delimiter(',')
      ->capture_default_str();
  verb->add_option("--runs", options->runs, "Drives of each situation and heading")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  verb->add_option("--seed", options->seed, "Seed of every random number")->capture_default_str();
  add_threads_option(*verb, options->threads);
  verb->add_flag("--learn", options->learn, "Learn the model anew, on worlds 101 to 106")
      ->excludes(worlds);
  verb->add_option("-o,--out", options->out, "Folder for what is written")->capture_default_str();
  verb->add_flag("--json", options->json, "Print JSON");
  verb->footer("Example: semview evaluate lost --worlds 1,2,3 -o lost");
  verb->callback([options, &exit_code] { exit_code = report(evaluate_lost(*options)); });
}

}  // namespace semview::cli
