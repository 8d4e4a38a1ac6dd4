// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "heatmap_source.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/io/npy.hpp"
#include "semview/io/output_path.hpp"
#include "semview/io/png.hpp"
#include "semview/io/text_file.hpp"
#include "semview/picture/heat_picture.hpp"
#include "server_option.hpp"
#include "verb.hpp"
#include "weighting_options.hpp"
#include "weights_option.hpp"

namespace semview::cli {
namespace {

using nlohmann::ordered_json;

struct Options {
  HeatMapInputs inputs;
  std::string output;
  std::string npy;
  int headings = PoseGrid::kHeadings;
  bool posterior = false;
  WeightingOptions weighting;
  bool clip = false;
  bool json = false;
};

Result<client::HeatMapQuestion> question_of(const Options& options) {
  if (options.headings < 1 || PoseGrid::kHeadings % options.headings != 0) {
    return fail(
        Error{ErrorCode::kInvalidArgument,
              fmt::format(
                  "--headings {}: expected a divisor of {}", options.headings, PoseGrid::kHeadings),
              "--headings"});
  }
  client::HeatMapQuestion question;
  question.headings = options.headings;
  if (options.posterior) {
    question.posterior = weighting_of(options.weighting);
    if (const Status valid = validate(*question.posterior); !valid) {
      const std::string option = "--" + valid.error().field;
      return fail(Error{ErrorCode::kInvalidArgument, "--" + valid.error().message, option});
    }
  }
  return question;
}

/// What is drawn and written.
const Image<float>& values_of(const client::HeatMapAnswer& answer) {
  return answer.probability.empty() ? answer.heat.similarity : answer.probability;
}

ordered_json number_at(const Image<float>& values, const CellIndex& cell, const CellIndex& origin) {
  const float value = values.at(cell.iy - origin.iy, cell.ix - origin.ix);
  return std::isnan(value) ? ordered_json(nullptr) : ordered_json(value);
}

/// What a heat map says about itself: printed, and written beside the `.npy`.
ordered_json describe(const HeatMapOfMap& made, const client::HeatMapQuestion& question) {
  const similarity::HeatMap& heat = made.answer.heat;
  const GridKey best = heat.highest(values_of(made.answer));
  const Pose2 pose = PoseGrid::center(best);
  ordered_json about{
      {"quantity", question.posterior ? "probability" : "similarity"},
      {"map", made.id},
      {"fingerprint", to_hex(made.fingerprint)},
      {"engine", made.engine},
      {"engine_reason", made.engine_reason},
      {"origin_m",
       {heat.origin.ix * PoseGrid::kCellSize_m, heat.origin.iy * PoseGrid::kCellSize_m}},
      {"origin_cell", {heat.origin.ix, heat.origin.iy}},
      {"step_m", PoseGrid::kCellSize_m},
      {"rows", heat.similarity.rows()},
      {"columns", heat.similarity.columns()},
      {"row_0", "lowest y"},
      {"headings", question.headings},
      {"best",
       {{"x_m", pose.x_m},
        {"y_m", pose.y_m},
        {"yaw_deg", shown_deg(pose.yaw_rad)},
        {"similarity", number_at(heat.similarity, best.cell, heat.origin)}}},
      {"cells",
       {{"memory", heat.origins.memory},
        {"disk", heat.origins.disk},
        {"cast", heat.origins.cast}}}};
  if (question.posterior) {
    const bool power = question.posterior->transform == observation::WeightTransform::kPower;
    about["weighting"] = {
        {"transform", power ? "power" : "exponential"},
        {power ? "power" : "kappa", power ? question.posterior->power : question.posterior->kappa}};
    about["best"]["probability"] = number_at(made.answer.probability, best.cell, heat.origin);
  }
  return about;
}

Status write_npy(const std::string& path, const Image<float>& values, const ordered_json& about) {
  SEMVIEW_TRY_STATUS(io::write_npy(path, values));
  return io::write_text_file(std::filesystem::path(path).replace_extension(".json"),
                             about.dump(2) + "\n");
}

RgbImage draw(const HeatMapOfMap& made, const std::string& quantity) {
  const similarity::HeatMap& heat = made.answer.heat;
  picture::HeatPicture picture;
  picture.values = values_of(made.answer);
  picture.quantity = quantity;
  picture.step_m = PoseGrid::kCellSize_m;
  picture.x_min_m = heat.origin.ix * PoseGrid::kCellSize_m;
  picture.y_min_m = heat.origin.iy * PoseGrid::kCellSize_m;
  picture.best = PoseGrid::center(heat.highest(picture.values));
  picture.title = made.name;
  picture.plan = made.plan;
  return picture::draw_heat_map(picture);
}

void print(const Options& options, const HeatMapOfMap& made, const ordered_json& about) {
  const ordered_json& best = about["best"];
  const std::string similarity = best["similarity"].is_null()
                                     ? std::string("unknown")
                                     : fmt::format("{:.4f}", best["similarity"].get<double>());
  fmt::print(
      "{}: {} cell{}, best {} at {:g},{:g},{:g}\n",
      options.output,
      made.cells,
      made.cells == 1 ? "" : "s",
      options.posterior
          ? fmt::format("{:.3g} (similarity {})", best["probability"].get<double>(), similarity)
          : similarity,
      best["x_m"].get<double>(),
      best["y_m"].get<double>(),
      best["yaw_deg"].get<double>());
}

Status heatmap(const CLI::App& verb, const Options& options) {
  if (!options.inputs.server.empty()) SEMVIEW_TRY_STATUS(check_no_site_options(verb));
  SEMVIEW_TRY(const client::HeatMapQuestion question, question_of(options));
  SEMVIEW_TRY_STATUS(io::check_output_png(options.output));
  if (!options.npy.empty()) SEMVIEW_TRY_STATUS(io::check_output_file(options.npy));
  SEMVIEW_TRY(HeatMapOfMap made, heat_map_of(options.inputs, question));
  const ordered_json about = describe(made, question);
  if (options.clip) {
    for (float& value : made.answer.heat.similarity.pixels()) {
      if (value < 0.0F) value = 0.0F;
    }
  }
  SEMVIEW_TRY_STATUS(io::write_png(options.output, draw(made, about["quantity"])));
  if (!options.npy.empty()) {
    SEMVIEW_TRY_STATUS(write_npy(options.npy, values_of(made.answer), about));
  }
  if (options.json) {
    fmt::print("{}\n", about.dump(2));
  } else {
    print(options, made, about);
  }
  return {};
}

}  // namespace

void add_heatmap_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "heatmap",
      "Compare an observation with the views of every free cell of the map and draw where it "
      "fits: the similarity of the best heading on the 10 cm grid, or with --posterior the "
      "probability of each cell.");
  const auto options = std::make_shared<Options>();
  add_site_options(*verb, options->inputs.site);
  add_server_option(*verb, options->inputs.server, "compare (the picture then shows no plan)");
  add_observation_option(*verb, options->inputs.observation);
  add_weights_option(*verb, options->inputs.weights)->required();
  verb->add_option("-o,--output", options->output, "Picture to write")
      ->type_name("FILE.png")
      ->required();
  verb->add_option(
          "--npy",
          options->npy,
          "Also write the values, row 0 = lowest y, NaN where no cell is free; what they are, "
          "origin, step and fingerprint go into a .json beside it")
      ->type_name("FILE.npy");
  CLI::Option* headings =
      verb->add_option("--headings", options->headings, "Headings to try, a divisor of 120")
          ->capture_default_str();
  CLI::Option* clip =
      verb->add_flag("--clip-negative", options->clip, "Draw and write negative similarities as 0");
  CLI::Option* posterior =
      verb->add_flag("--posterior",
                     options->posterior,
                     "Draw and write the probability that the eye was in each cell, whatever the "
                     "heading: 1 over all free cells and headings, with the weights below")
          ->excludes(headings)
          ->excludes(clip);
  add_weighting_options(*verb, options->weighting);
  for (const char* option : {"--weighting", "--power", "--kappa"}) {
    verb->get_option(option)->needs(posterior);
  }
  verb->add_flag("--json", options->json, "Print the result as JSON");
  verb->footer(
      "Example: semview heatmap maps/duplex_level1 --obs obs --weights "
      "maps/duplex_level1/weights.csv -o heat.png --npy heat.npy");
  verb->callback([verb, options, &exit_code] { exit_code = report(heatmap(*verb, *options)); });
}

}  // namespace semview::cli
