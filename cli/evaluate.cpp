// SPDX-License-Identifier: Apache-2.0
/// `semview evaluate`, and `semview evaluate run`.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "evaluate_verbs.hpp"
#include "plan_backdrop.hpp"
#include "semview/evaluation/particles_file.hpp"
#include "semview/evaluation/run_metrics.hpp"
#include "semview/io/output_path.hpp"
#include "semview/io/png.hpp"
#include "semview/io/run_log.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/picture/track_picture.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

using evaluation::TrackErrors;

struct Options {
  std::string log;
  std::vector<std::string> estimates;
  bool json = false;
  std::string svg;
  std::string png;
  std::string map;
  std::string particles;
  std::string title;
  double converged_within_m = evaluation::kConvergedWithin_m;
  std::optional<double> final_within_m;
};

struct Evaluated {
  std::string name;
  std::vector<io::StampedPose2> poses;
  TrackErrors errors;
  TrackErrors odometry_errors;  ///< of odometry at the same stamps
};

struct Evaluation {
  std::vector<io::StampedPose2> truth;
  std::vector<io::StampedPose2> odometry;  ///< aligned to the truth
  std::vector<Evaluated> estimates;
};

Result<Evaluation> evaluate(const Options& options) {
  SEMVIEW_TRY(io::RunLog log, io::read_run_log(options.log));
  if (!log.groundtruth) {
    return fail(ErrorCode::kFailedPrecondition,
                fmt::format("{}: has no groundtruth.txt to compare with", options.log));
  }
  Evaluation evaluation;
  evaluation.truth = *std::move(log.groundtruth);
  SEMVIEW_TRY(evaluation.odometry, evaluation::align_odometry(log.odometry, evaluation.truth));
  for (const std::string& file : options.estimates) {
    Evaluated estimate;
    estimate.name = file;
    SEMVIEW_TRY(estimate.poses, io::read_tum(file));
    Result<TrackErrors> errors =
        evaluation::compare(estimate.poses, evaluation.truth, options.converged_within_m);
    if (!errors) return with_context(std::move(errors), file);
    estimate.errors = *errors;
    Result<TrackErrors> odometry_errors =
        evaluation::compare(evaluation::sample(evaluation.odometry, estimate.poses),
                            evaluation.truth,
                            options.converged_within_m);
    if (!odometry_errors) return with_context(std::move(odometry_errors), file + ": odometry");
    estimate.odometry_errors = *odometry_errors;
    evaluation.estimates.push_back(std::move(estimate));
  }
  return evaluation;
}

nlohmann::json json_of(const evaluation::ErrorSummary& summary, double unit) {
  return {{"mean", summary.mean * unit},
          {"median", summary.median * unit},
          {"max", summary.max * unit},
          {"final", summary.final * unit}};
}

nlohmann::json json_of(const TrackErrors& errors) {
  nlohmann::json json = {{"stamps", errors.stamps},
                         {"skipped", errors.skipped},
                         {"position_m", json_of(errors.position_m, 1.0)},
                         {"heading_deg", json_of(errors.heading_rad, deg_from_rad(1.0))},
                         {"converged_after_s", nullptr}};
  if (errors.converged_after_s) json["converged_after_s"] = *errors.converged_after_s;
  return json;
}

void print_json(const Options& options, const Evaluation& evaluation) {
  nlohmann::json json = {{"log", options.log},
                         {"converged_within_m", options.converged_within_m},
                         {"estimates", nlohmann::json::array()}};
  for (const Evaluated& estimate : evaluation.estimates) {
    json["estimates"].push_back({{"file", estimate.name},
                                 {"estimate", json_of(estimate.errors)},
                                 {"odometry", json_of(estimate.odometry_errors)}});
  }
  fmt::print("{}\n", json.dump(2));
}

void print_row(const std::string& name, std::size_t width, const TrackErrors& errors) {
  const std::string converged =
      errors.converged_after_s ? fmt::format("{:.1f} s", *errors.converged_after_s) : "never";
  fmt::print(
      "{:<{}}  {:>7.3f} {:>7.3f} {:>7.3f} {:>7.3f}  {:>7.2f} {:>7.2f} {:>7.2f} {:>7.2f}  {:>9}\n",
      name,
      width,
      errors.position_m.mean,
      errors.position_m.median,
      errors.position_m.max,
      errors.position_m.final,
      deg_from_rad(errors.heading_rad.mean),
      deg_from_rad(errors.heading_rad.median),
      deg_from_rad(errors.heading_rad.max),
      deg_from_rad(errors.heading_rad.final),
      converged);
}

void print_table(const Options& options, const Evaluation& evaluation) {
  constexpr std::string_view kOdometry = "  odometry";
  std::size_t width = kOdometry.size();
  for (const Evaluated& estimate : evaluation.estimates) {
    width = std::max(width, estimate.name.size());
  }
  fmt::print("{:<{}}  {:^31}  {:^31}  {:>9}\n",
             "",
             width,
             "position error in m",
             "heading error in degrees",
             fmt::format("< {:g} m", options.converged_within_m));
  fmt::print("{:<{}}  {:>7} {:>7} {:>7} {:>7}  {:>7} {:>7} {:>7} {:>7}  {:>9}\n",
             "",
             width,
             "mean",
             "median",
             "max",
             "final",
             "mean",
             "median",
             "max",
             "final",
             "after");
  for (const Evaluated& estimate : evaluation.estimates) {
    print_row(estimate.name, width, estimate.errors);
    print_row(std::string(kOdometry), width, estimate.odometry_errors);
  }
}

std::vector<Pose2> poses_of(const std::vector<io::StampedPose2>& samples) {
  std::vector<Pose2> poses;
  poses.reserve(samples.size());
  for (const io::StampedPose2& sample : samples) poses.push_back(sample.pose);
  return poses;
}

Result<picture::TrackPicture> picture_of(const Options& options, const Evaluation& evaluation) {
  picture::TrackPicture drawing;
  drawing.title = options.title.empty()
                      ? std::filesystem::path(options.log).lexically_normal().filename().string()
                      : options.title;
  if (!options.map.empty()) {
    SEMVIEW_TRY(const map::SemanticMap map, map::load_map(options.map));
    SEMVIEW_TRY(drawing.plan, plan_backdrop(map));
  }
  if (!options.particles.empty()) {
    SEMVIEW_TRY(drawing.particles, evaluation::read_particles(options.particles));
  }
  drawing.tracks.push_back({"truth", picture::kTruthColour, false, poses_of(evaluation.truth)});
  drawing.tracks.push_back(
      {"odometry", picture::kOdometryColour, true, poses_of(evaluation.odometry)});
  // The first in the colour of all estimates, further ones told apart.
  constexpr Rgb kColours[] = {
      picture::kEstimateColour, {204, 121, 167}, {86, 180, 233}, {230, 159, 0}};
  for (std::size_t i = 0; i < evaluation.estimates.size(); ++i) {
    const Evaluated& estimate = evaluation.estimates[i];
    const std::string name = evaluation.estimates.size() == 1 ? "estimate" : estimate.name;
    drawing.tracks.push_back(
        {name, kColours[i % std::size(kColours)], false, poses_of(estimate.poses)});
  }
  return drawing;
}

Status draw(const Options& options, const Evaluation& evaluation) {
  if (options.svg.empty() && options.png.empty()) return {};
  SEMVIEW_TRY(const picture::TrackPicture drawing, picture_of(options, evaluation));
  if (!options.svg.empty()) {
    SEMVIEW_TRY_STATUS(picture::write_tracks_svg(options.svg, drawing));
  }
  if (!options.png.empty()) {
    SEMVIEW_TRY_STATUS(io::write_png(options.png, picture::draw_tracks(drawing)));
  }
  return {};
}

Status check_final(const Options& options, const Evaluation& evaluation) {
  if (!options.final_within_m) return {};
  for (const Evaluated& estimate : evaluation.estimates) {
    const double error_m = estimate.errors.position_m.final;
    const double odometry_m = estimate.odometry_errors.position_m.final;
    if (!(error_m <= *options.final_within_m && error_m < odometry_m)) {
      return fail(ErrorCode::kOutOfRange,
                  fmt::format("{}: ends {:.3f} m from the truth, odometry {:.3f} m; expected at "
                              "most {:g} m and nearer than odometry",
                              estimate.name,
                              error_m,
                              odometry_m,
                              *options.final_within_m));
    }
  }
  return {};
}

Status check_limit(const char* option, double limit_m) {
  if (limit_m > 0.0 && std::isfinite(limit_m)) return {};
  return fail(
      Error{ErrorCode::kInvalidArgument,
            fmt::format("{} {}: expected a finite number of metres above 0", option, limit_m),
            option});
}

Status run(const Options& options) {
  SEMVIEW_TRY_STATUS(check_limit("--converged-within", options.converged_within_m));
  if (options.final_within_m) {
    SEMVIEW_TRY_STATUS(check_limit("--final-within", *options.final_within_m));
  }
  std::vector<std::string> inputs = options.estimates;
  inputs.push_back(options.particles);
  if (!options.svg.empty()) {
    SEMVIEW_TRY_STATUS(io::check_output_file(options.svg));
    SEMVIEW_TRY_STATUS(io::check_is_no_input(options.svg, inputs));
  }
  if (!options.png.empty()) SEMVIEW_TRY_STATUS(io::check_output_png(options.png));
  SEMVIEW_TRY(const Evaluation evaluation, evaluate(options));
  if (options.json) {
    print_json(options, evaluation);
  } else {
    print_table(options, evaluation);
  }
  SEMVIEW_TRY_STATUS(draw(options, evaluation));
  return check_final(options, evaluation);
}

}  // namespace

void add_evaluate_verb(CLI::App& app, int& exit_code) {
  CLI::App* evaluate_verb = app.add_subcommand("evaluate", "Compare results with the truth");
  evaluate_verb->require_subcommand(1);
  CLI::App* verb = evaluate_verb->add_subcommand(
      "run",
      "Position and heading errors of estimated trajectories (TUM files) against a run log's "
      "ground "
      "truth, at the estimate's own stamps, beside those of odometry alone, which is put on the "
      "ground truth's first pose. The last column tells after how many seconds the position error "
      "went below the limit and stayed there.");
  const auto options = std::make_shared<Options>();
  verb->add_option("--log", options->log, "Folder of the run log")->required();
  verb->add_option("ESTIMATE", options->estimates, "est.tum files")->required();
  verb->add_flag("--json", options->json, "Print JSON");
  verb->add_option("--svg", options->svg, "Draw the tracks into this SVG");
  verb->add_option("--png", options->png, "Draw the tracks into this PNG");
  verb->add_option("--map", options->map, "Map whose plan lies under the tracks");
  verb->add_option("--particles", options->particles, "Particles (CSV of `localize`) to draw");
  verb->add_option("--title", options->title, "Title of the picture; default: the log's name");
  verb->add_option("--converged-within", options->converged_within_m, "Limit in metres")
      ->capture_default_str();
  verb->add_option(
      "--final-within",
      options->final_within_m,
      "Exit with 1 unless every estimate ends within this many metres of the truth and "
      "nearer than odometry");
  verb->footer(
      "Example: semview evaluate run --log run1 run1/est.tum --map maps/duplex_level1 "
      "--svg run1.svg");
  verb->callback([options, &exit_code] { exit_code = report(run(*options)); });
  add_evaluate_logs_verb(*evaluate_verb, exit_code);
  add_evaluate_lost_verb(*evaluate_verb, exit_code);
  add_evaluate_paper2017_verb(*evaluate_verb, exit_code);
  add_evaluate_paper2023_verb(*evaluate_verb, exit_code);
  add_evaluate_images(*evaluate_verb, exit_code);
  add_evaluate_rooms_verb(*evaluate_verb, exit_code);
  add_evaluate_sketches_verb(*evaluate_verb, exit_code);
}

}  // namespace semview::cli
