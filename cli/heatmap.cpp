// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "observation_option.hpp"
#include "plan_backdrop.hpp"
#include "semview/core/hash.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/io/npy.hpp"
#include "semview/io/output_path.hpp"
#include "semview/io/png.hpp"
#include "semview/io/text_file.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/picture/heat_picture.hpp"
#include "semview/similarity/heat_map.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "site_options.hpp"
#include "verb.hpp"
#include "weights_option.hpp"

namespace semview::cli {
namespace {

using nlohmann::ordered_json;

struct Options {
  SiteOptions site;
  ObservationOption observation;
  std::string weights;
  std::string output;
  std::string npy;
  int headings = PoseGrid::kHeadings;
  bool clip = false;
  bool json = false;
};

/// What a heat map says about itself: printed, and written beside the `.npy`.
ordered_json describe(const service::Site& site, const similarity::HeatMap& heat, int headings) {
  const GridKey best = heat.best();
  const Pose2 pose = PoseGrid::center(best);
  const float similarity =
      heat.similarity.at(best.cell.iy - heat.origin.iy, best.cell.ix - heat.origin.ix);
  return {
      {"quantity", "similarity"},
      {"map", site.id()},
      {"fingerprint", to_hex(site.map().fingerprint)},
      {"engine", site.engine().name},
      {"engine_reason", site.engine().reason},
      {"origin_m",
       {heat.origin.ix * PoseGrid::kCellSize_m, heat.origin.iy * PoseGrid::kCellSize_m}},
      {"origin_cell", {heat.origin.ix, heat.origin.iy}},
      {"step_m", PoseGrid::kCellSize_m},
      {"rows", heat.similarity.rows()},
      {"columns", heat.similarity.columns()},
      {"row_0", "lowest y"},
      {"headings", headings},
      {"best",
       {{"x_m", pose.x_m},
        {"y_m", pose.y_m},
        {"yaw_deg", shown_deg(pose.yaw_rad)},
        {"similarity", std::isnan(similarity) ? ordered_json(nullptr) : ordered_json(similarity)}}},
      {"cells",
       {{"memory", heat.origins.memory},
        {"disk", heat.origins.disk},
        {"cast", heat.origins.cast}}}};
}

Status write_npy(const std::string& path, const Image<float>& values, const ordered_json& about) {
  SEMVIEW_TRY_STATUS(io::write_npy(path, values));
  return io::write_text_file(std::filesystem::path(path).replace_extension(".json"),
                             about.dump(2) + "\n");
}

RgbImage draw(const service::Site& site, const similarity::HeatMap& heat) {
  picture::HeatPicture picture;
  picture.values = heat.similarity;
  picture.step_m = PoseGrid::kCellSize_m;
  picture.x_min_m = heat.origin.ix * PoseGrid::kCellSize_m;
  picture.y_min_m = heat.origin.iy * PoseGrid::kCellSize_m;
  picture.best = PoseGrid::center(heat.best());
  picture.title = site.map().name;
  if (site.map().columns() != nullptr) {  // of a mesh the values themselves show the free cells
    if (Result<picture::Plan> plan = plan_backdrop(site.map())) picture.plan = *std::move(plan);
  }
  return picture::draw_heat_map(picture);
}

bool show_progress(std::size_t done, std::size_t cells) {
  fmt::print(stderr, "\r{} of {} cells{}", done, cells, done == cells ? "\n" : "");
  return true;
}

Status heatmap(const Options& options) {
  if (options.headings < 1 || PoseGrid::kHeadings % options.headings != 0) {
    return fail(
        Error{ErrorCode::kInvalidArgument,
              fmt::format(
                  "--headings {}: expected a divisor of {}", options.headings, PoseGrid::kHeadings),
              "--headings"});
  }
  SEMVIEW_TRY_STATUS(io::check_output_png(options.output));
  if (!options.npy.empty()) SEMVIEW_TRY_STATUS(io::check_output_file(options.npy));
  SEMVIEW_TRY(const std::shared_ptr<service::Site> site, open_site(options.site));
  SEMVIEW_TRY(const Observation observation, read(options.observation, site->profile().camera));
  SEMVIEW_TRY(const similarity::WeightMatrix weights,
              read_weights(options.weights, observation.classes, site->map().classes));
  SEMVIEW_TRY(const similarity::PreparedObservation prepared,
              similarity::PreparedObservation::build(
                  observation, weights, site->map().classes, site->profile().camera));
  const std::vector<CellIndex> cells = site->cells().free_cells();
  SEMVIEW_TRY(
      similarity::HeatMap heat,
      similarity::heat_map(prepared,
                           site->views(),
                           cells,
                           options.headings,
                           site->pool(),
                           isatty(STDERR_FILENO) != 0
                               ? std::function<bool(std::size_t, std::size_t)>(show_progress)
                               : nullptr));
  const ordered_json about = describe(*site, heat, options.headings);
  if (options.clip) {
    for (float& value : heat.similarity.pixels()) {
      if (value < 0.0F) value = 0.0F;
    }
  }
  SEMVIEW_TRY_STATUS(io::write_png(options.output, draw(*site, heat)));
  if (!options.npy.empty()) {
    SEMVIEW_TRY_STATUS(write_npy(options.npy, heat.similarity, about));
  }
  if (options.json) {
    fmt::print("{}\n", about.dump(2));
    return {};
  }
  const ordered_json& best = about["best"];
  fmt::print("{}: {} cell{}, best {} at {:g},{:g},{:g}\n",
             options.output,
             cells.size(),
             cells.size() == 1 ? "" : "s",
             best["similarity"].is_null() ? std::string("unknown")
                                          : fmt::format("{:.4f}", best["similarity"].get<double>()),
             best["x_m"].get<double>(),
             best["y_m"].get<double>(),
             best["yaw_deg"].get<double>());
  return {};
}

}  // namespace

void add_heatmap_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "heatmap",
      "Compare an observation with the views of every free cell of the map and draw where it "
      "fits: the similarity of the best heading on the 10 cm grid.");
  const auto options = std::make_shared<Options>();
  add_site_options(*verb, options->site);
  add_observation_option(*verb, options->observation);
  add_weights_option(*verb, options->weights)->required();
  verb->add_option("-o,--output", options->output, "Picture to write")
      ->type_name("FILE.png")
      ->required();
  verb->add_option(
          "--npy",
          options->npy,
          "Also write the values, row 0 = lowest y, NaN where no cell is free; origin, step "
          "and fingerprint go into a .json beside it")
      ->type_name("FILE.npy");
  verb->add_option("--headings", options->headings, "Headings to try, a divisor of 120")
      ->capture_default_str();
  verb->add_flag("--clip-negative", options->clip, "Draw and write negative similarities as 0");
  verb->add_flag("--json", options->json, "Print the result as JSON");
  verb->footer(
      "Example: semview heatmap maps/duplex_level1 --obs obs --weights "
      "maps/duplex_level1/weights.csv -o heat.png --npy heat.npy");
  verb->callback([options, &exit_code] { exit_code = report(heatmap(*options)); });
}

}  // namespace semview::cli
