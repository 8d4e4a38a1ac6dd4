// SPDX-License-Identifier: Apache-2.0
/// `semview locate`.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "eye_heights.hpp"
#include "observation_option.hpp"
#include "place_weights.hpp"
#include "plan_backdrop.hpp"
#include "semview/core/hash.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/io/output_path.hpp"
#include "semview/io/png.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/observation/dense_posterior.hpp"
#include "semview/picture/heat_picture.hpp"
#include "semview/places/place_search.hpp"
#include "verb.hpp"
#include "waiting_line.hpp"
#include "weights_option.hpp"

namespace semview::cli {
namespace {

using nlohmann::ordered_json;
using Floors = std::vector<std::shared_ptr<service::Site>>;

struct Options {
  EyeHeightOptions floors;
  ObservationOption observation;
  std::string weights;
  std::size_t top = 5;
  std::string heatmap;
  bool json = false;
};

/// The probability of each cell in all its headings, before anything was refined.
RgbImage draw(const service::Site& site, const places::PlaceSearch& search) {
  const observation::DensePosterior& posterior = *search.posterior;
  CellIndex low = posterior.cells().front();
  CellIndex high = low;
  for (const CellIndex& cell : posterior.cells()) {
    low = {std::min(low.ix, cell.ix), std::min(low.iy, cell.iy)};
    high = {std::max(high.ix, cell.ix), std::max(high.iy, cell.iy)};
  }
  picture::HeatPicture picture;
  picture.values = Image<float>(
      high.iy - low.iy + 1, high.ix - low.ix + 1, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < posterior.cells().size(); ++i) {
    double probability = 0.0;
    for (int k = 0; k < PoseGrid::kHeadings; ++k) probability += posterior.probability(i, k);
    const CellIndex& cell = posterior.cells()[i];
    picture.values.at(cell.iy - low.iy, cell.ix - low.ix) = static_cast<float>(probability);
  }
  picture.step_m = PoseGrid::kCellSize_m;
  picture.x_min_m = low.ix * PoseGrid::kCellSize_m;
  picture.y_min_m = low.iy * PoseGrid::kCellSize_m;
  picture.quantity = "probability";
  if (!search.places.empty()) picture.best = search.places.front().map_from_robot;
  picture.title = site.map().name;
  if (site.map().columns() != nullptr) {
    if (Result<picture::Plan> plan = plan_backdrop(site.map())) picture.plan = *std::move(plan);
  }
  return picture::draw_heat_map(picture);
}

void print_json(const Floors& floors, const places::PlaceSearch& search) {
  ordered_json places = ordered_json::array();
  for (const places::Place& place : search.places) {
    places.push_back({{"x_m", place.map_from_robot.x_m},
                      {"y_m", place.map_from_robot.y_m},
                      {"yaw_rad", place.map_from_robot.yaw_rad},
                      {"yaw_deg", shown_deg(place.map_from_robot.yaw_rad)},
                      {"probability", place.probability},
                      {"score", place.score},
                      {"eye_height_m", place.eye_height_m}});
  }
  const double second = search.places.size() > 1 ? search.places[1].probability : 0.0;
  const ordered_json json{{"map", floors[0]->id()},
                          {"fingerprint", to_hex(floors[0]->map().fingerprint)},
                          {"engine", floors[0]->engine().name},
                          {"engine_reason", floors[0]->engine().reason},
                          {"cells", search.cells},
                          {"places", std::move(places)},
                          {"ambiguity",
                           {{"entropy_bits", search.entropy_bits},
                            {"effective_places", std::exp2(search.entropy_bits)},
                            {"second_probability", second}}}};
  fmt::print("{}\n", json.dump(2, ' ', false, ordered_json::error_handler_t::replace));
}

void print_table(const places::PlaceSearch& search) {
  fmt::print("{:>9} {:>9} {:>9} {:>12} {:>10} {:>8}\n",
             "x m",
             "y m",
             "yaw deg",
             "probability",
             "eye m",
             "score");
  for (const places::Place& place : search.places) {
    fmt::print("{:9.3f} {:9.3f} {:9.1f} {:12.3f} {:10.2f} {:8.3f}\n",
               place.map_from_robot.x_m,
               place.map_from_robot.y_m,
               deg_from_rad(place.map_from_robot.yaw_rad),
               place.probability,
               place.eye_height_m,
               place.score);
  }
  fmt::print("as ambiguous as {:.1f} equally likely places ({:.2f} bits)\n",
             std::exp2(search.entropy_bits),
             search.entropy_bits);
}

Status locate(const Options& options) {
  if (!options.heatmap.empty()) SEMVIEW_TRY_STATUS(io::check_output_png(options.heatmap));
  SEMVIEW_TRY(const ClassTable observed, read_observed_classes(options.observation));
  SEMVIEW_TRY(const Floors floors, open_floors(options.floors));
  SEMVIEW_TRY(const Observation observation,
              read(options.observation, floors[0]->profile().camera));
  SEMVIEW_TRY(const similarity::WeightMatrix weights,
              place_weights(options.weights, observed, floors[0]->map()));
  places::PlaceSearchConfig config;
  config.most_places = options.top;
  WaitingLine line = waiting_for_views(options.floors.site.cache_directory);
  SEMVIEW_TRY(const places::PlaceSearch search,
              places::find_places(floors,
                                  observation,
                                  weights,
                                  config,
                                  [&](std::size_t done, std::size_t all, std::string_view unit) {
                                    line.show(done, all, unit);
                                  }));
  if (search.places.empty()) {
    return fail(ErrorCode::kFailedPrecondition,
                fmt::format("map {}: no free cell has a view to compare with", floors[0]->id()));
  }
  if (!options.heatmap.empty()) {
    SEMVIEW_TRY_STATUS(io::write_png(options.heatmap, draw(*floors[search.best_floor], search)));
  }
  if (options.json) {
    print_json(floors, search);
  } else {
    print_table(search);
  }
  return {};
}

}  // namespace

void add_locate_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "locate",
      "Where was this single picture taken? Compares an observation with the views of all free "
      "cells in all headings, then searches on between the cells around the best of them. Lists "
      "the places, strongest first, and how ambiguous they are.");
  const auto options = std::make_shared<Options>();
  add_eye_height_options(*verb, options->floors);
  add_observation_option(*verb, options->observation);
  add_weights_option(*verb, options->weights)
      ->description(
          "Logarithms of likelihood ratios (`semview weights learn`); without it they are made "
          "from "
          "the class names and what networks are known to err in");
  verb->add_option("--top", options->top, "Places to list")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  verb->add_option("--heatmap", options->heatmap, "Draw the probability of each cell")
      ->type_name("FILE.png");
  verb->add_flag("--json", options->json, "Print the places as JSON");
  verb->footer("Example: semview locate maps/duplex_level1 --obs obs --heatmap where.png");
  verb->callback([options, &exit_code] { exit_code = report(locate(*options)); });
}

}  // namespace semview::cli
