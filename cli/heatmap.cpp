// SPDX-License-Identifier: Apache-2.0
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

#include "heatmap_findings.hpp"
#include "heatmap_source.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/io/npy.hpp"
#include "semview/io/output_path.hpp"
#include "semview/io/png.hpp"
#include "semview/io/text_file.hpp"
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
  std::optional<double> heading_deg;
  bool json = false;
};

bool scores_depth(const Options& options) {
  return options.inputs.models != std::vector<std::string>{std::string(name(ScoreModel::kViews))};
}

tl::unexpected<Error> usage(const std::string& option, const std::string& message) {
  return fail(Error{ErrorCode::kInvalidArgument, fmt::format("{}: {}", option, message), option});
}

/// Options of one kind of model with the other.
Status check_models(const CLI::App& verb, const Options& options) {
  const std::vector<std::string>& models = options.inputs.models;
  const bool depth = scores_depth(options);
  if (depth && std::ranges::count(models, name(ScoreModel::kViews)) > 0) {
    return usage("--model", "`views` stands alone");
  }
  if (!options.npy.empty() && models.size() > 1) {
    return usage("--npy", fmt::format("holds the values of one model, not of {}", models.size()));
  }
  ModelOptions settings = options.inputs.depth;
  settings.model = models.front();
  SEMVIEW_TRY_STATUS(check_model_options(verb, settings));
  if (!depth) {
    if (options.inputs.weights.empty()) return usage("--weights", "is required to compare views");
    if (options.heading_deg) return usage("--heading", "needs a --model of depth");
    return {};
  }
  for (const char* option : {"--weights", "--weighting", "--power", "--kappa", "--clip-negative"}) {
    if (verb.get_option(option)->count() == 0) continue;
    return usage(option, fmt::format("needs --model views, not {}", models.front()));
  }
  if (options.heading_deg && !options.inputs.server.empty()) {
    return usage("--heading", "needs a map in this process");
  }
  return {};
}

/// Of views, and on a server, the headings are every nth of the grid.
bool can_try(const Options& options) {
  if (options.headings < 1 || options.headings > PoseGrid::kHeadings) return false;
  const bool evenly = PoseGrid::kHeadings % options.headings == 0;
  return evenly || (scores_depth(options) && options.inputs.server.empty());
}

Result<client::HeatMapQuestion> question_of(const Options& options) {
  if (!can_try(options)) {
    return fail(
        Error{ErrorCode::kInvalidArgument,
              fmt::format(
                  "--headings {}: expected a divisor of {}", options.headings, PoseGrid::kHeadings),
              "--headings"});
  }
  client::HeatMapQuestion question;
  question.headings = options.heading_deg ? 1 : options.headings;
  if (options.posterior) {
    question.posterior = weighting_of(options.weighting);
    if (scores_depth(options)) {
      question.posterior = {.transform = observation::WeightTransform::kExponential,
                            .kappa = options.inputs.depth.effective_pixels};
    }
    if (const Status valid = validate(*question.posterior); !valid) {
      const std::string option = "--" + valid.error().field;
      return fail(Error{ErrorCode::kInvalidArgument, "--" + valid.error().message, option});
    }
  }
  return question;
}

Status write_npy(const std::string& path, const Image<float>& values, const ordered_json& about) {
  SEMVIEW_TRY_STATUS(io::write_npy(path, values));
  return io::write_text_file(std::filesystem::path(path).replace_extension(".json"),
                             about.dump(2) + "\n");
}

void print_json(const std::vector<ordered_json>& about) {
  fmt::print("{}\n", about.size() == 1 ? about.front().dump(2) : ordered_json(about).dump(2));
}

Status heatmap(const CLI::App& verb, const Options& options) {
  if (!options.inputs.server.empty()) SEMVIEW_TRY_STATUS(check_no_site_options(verb));
  SEMVIEW_TRY_STATUS(check_models(verb, options));
  SEMVIEW_TRY(const client::HeatMapQuestion question, question_of(options));
  SEMVIEW_TRY_STATUS(io::check_output_png(options.output));
  if (!options.npy.empty()) SEMVIEW_TRY_STATUS(io::check_output_file(options.npy));
  HeatMapInputs inputs = options.inputs;
  if (options.heading_deg) inputs.heading_yaw_rad = rad_from_deg(*options.heading_deg);
  SEMVIEW_TRY(std::vector<HeatMapOfMap> made, heat_maps_of(inputs, question));
  std::vector<ordered_json> about;
  for (const HeatMapOfMap& one : made) about.push_back(describe(one, question));
  if (options.clip) {
    for (float& value : made.front().answer.heat.similarity.pixels()) {
      if (value < 0.0F) value = 0.0F;
    }
  }
  SEMVIEW_TRY_STATUS(io::write_png(options.output, draw(made, about)));
  if (!options.npy.empty()) {
    SEMVIEW_TRY_STATUS(write_npy(options.npy, values_of(made.front().answer), about.front()));
  }
  if (options.json) {
    print_json(about);
    return {};
  }
  for (std::size_t i = 0; i < made.size(); ++i)
    fmt::print("{}: {}\n", options.output, in_words(made[i], about[i]));
  return {};
}

/// Whether a heading can be given: a finite number.
std::string not_finite(const std::string& text) {
  const Result<std::vector<double>> number = parse_numbers("--heading", text, 1);
  return number ? std::string() : number.error().message;
}

}  // namespace

void add_heatmap_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "heatmap",
      "Compare an observation with every free cell of the map and draw where it fits: the "
      "similarity of the best heading on the 10 cm grid, or with --posterior the probability of "
      "each cell. By views of labels, or with --model by a depth image.");
  const auto options = std::make_shared<Options>();
  add_site_options(*verb, options->inputs.site);
  add_server_option(*verb, options->inputs.server, "compare (the picture then shows no plan)");
  add_observation_option(*verb, options->inputs.observation);
  add_weights_option(*verb, options->inputs.weights);
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
      verb->add_option("--headings",
                       options->headings,
                       "Headings to try, a divisor of 120; of depth in this process any up to it")
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
  verb->add_option("--model",
                   options->inputs.models,
                   "What is compared: `views`, label panoramas; or the depth image of a run log's "
                   "frame by the distance to surfaces (`sdf`), to the same class (`sem`) or both "
                   "(`sdf_sem`). Several, comma-separated: side by side in one picture")
      ->delimiter(',')
      ->check(CLI::IsMember({"views", "sdf", "sem", "sdf_sem"}))
      ->capture_default_str();
  verb->add_option("--heading", options->heading_deg, "Depth: the only heading tried, degrees")
      ->check(not_finite)
      ->excludes(headings)
      ->excludes(posterior);
  add_depth_options(*verb, options->inputs.depth);
  verb->add_flag("--json", options->json, "Print the result as JSON");
  verb->footer(
      "Example: semview heatmap maps/duplex_level1 --obs obs --weights "
      "maps/duplex_level1/weights.csv -o heat.png --npy heat.npy\n"
      "         semview heatmap maps/duplex_level1 --obs rgbd_drive --frame 10 --model "
      "sdf,sem,sdf_sem --headings 16 -o heat.png");
  verb->callback([verb, options, &exit_code] { exit_code = report(heatmap(*verb, *options)); });
}

}  // namespace semview::cli
