// SPDX-License-Identifier: Apache-2.0
/// `semview evaluate images`.
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "evaluate_verbs.hpp"
#include "eye_heights.hpp"
#include "photo_labels.hpp"
#include "picture_set.hpp"
#include "place_weights.hpp"
#include "printed_places.hpp"
#include "semview/evaluation/place_recall.hpp"
#include "semview/map/fingerprint.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/places/naive_place.hpp"
#include "semview/places/place_search.hpp"
#include "semview/simulation/world.hpp"
#include "verb.hpp"
#include "weights_option.hpp"

namespace semview::cli {
namespace {

using evaluation::PlaceError;
using nlohmann::ordered_json;
using Floors = std::vector<std::shared_ptr<service::Site>>;

constexpr double kCrop_rad = kPi / 2.0;

struct Options {
  EyeHeightOptions floors;
  std::string list;
  std::string segment;  ///< the network that labels the list's photographs
  std::string camera;   ///< the rig that took them
  SimulatedPictures simulated;
  double missing_share = 0.0;
  std::string weights;
  bool crops = false;
  bool json = false;
  places::PlaceSearchConfig search;
};

/// One way to find places, and how it fared on whole panoramas or on crops.
struct Row {
  std::string method;
  std::string input;
  std::vector<PlaceError> errors;
};

/// The naive matcher names a place and no probability of it.
bool claims(const Row& row) { return row.method != "naive"; }

/// The drawing, without some of its furniture if so wanted.
Result<map::SemanticMap> emptied(const Options& options, map::SemanticMap map) {
  if (options.missing_share == 0.0) return map;
  if (map.columns() == nullptr) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      "--missing: the map is a mesh; furniture is taken out of drawn plans only",
                      "--missing"});
  }
  Rng rng(options.simulated.seed, "missing furniture");
  map.geometry = simulation::vary_plan(
                     map, {.height_error_m = 0.0, .missing_share = options.missing_share}, rng)
                     .plan;
  map.id += "_emptied";
  map.fingerprint = map::fingerprint_of(map);
  return map;
}

Result<PlaceError> find(const Floors& floors,
                        const similarity::WeightMatrix& weights,
                        const Observation& observation,
                        const Pose2& truth,
                        const places::PlaceSearchConfig& config) {
  SEMVIEW_TRY(const places::PlaceSearch search,
              places::find_places(floors, observation, weights, config));
  if (search.places.empty()) return PlaceError{std::numeric_limits<double>::infinity(), kPi, 0.0};
  return evaluation::place_error(
      search.places[0].map_from_robot, truth, search.places[0].probability);
}

Result<PlaceError> find_naively(const service::Site& floor,
                                const Observation& observation,
                                const Pose2& truth) {
  SEMVIEW_TRY(const std::optional<Pose2> place, places::naive_place(floor, observation));
  if (!place) return PlaceError{std::numeric_limits<double>::infinity(), kPi, 0.0};
  return evaluation::place_error(*place, truth, 1.0);
}

Result<std::vector<Row>> evaluate(const Options& options,
                                  const Floors& floors,
                                  const std::vector<KnownPicture>& pictures) {
  std::vector<Row> rows{{"semview", "panorama", {}}, {"naive", "panorama", {}}};
  if (options.crops) {
    rows.push_back({"semview", "90 deg crop", {}});
    rows.push_back({"naive", "90 deg crop", {}});
  }
  const std::string& source = options.list.empty() ? options.simulated.world : options.list;
  for (const KnownPicture& picture : pictures) {
    SEMVIEW_TRY(const similarity::WeightMatrix weights,
                place_weights(options.weights, picture.observation.classes, floors[0]->map()));
    std::vector<Observation> views{picture.observation};
    if (options.crops) {
      for (int k = 0; k < 4; ++k) {
        views.push_back(cropped(picture.observation, k * kCrop_rad, kCrop_rad));
      }
    }
    for (std::size_t v = 0; v < views.size(); ++v) {
      const std::size_t row = v == 0 ? 0 : 2;
      Result<PlaceError> found =
          find(floors, weights, views[v], picture.map_from_robot, options.search);
      if (!found) {
        return with_context(std::move(found), fmt::format("{}: {}", source, picture.name));
      }
      rows[row].errors.push_back(*found);
      SEMVIEW_TRY(const PlaceError naive,
                  find_naively(*floors[0], views[v], picture.map_from_robot));
      rows[row + 1].errors.push_back(naive);
    }
  }
  return rows;
}

void print_json(const Floors& floors, const std::vector<Row>& rows) {
  ordered_json list = ordered_json::array();
  for (const Row& row : rows) {
    const evaluation::PlaceRecall recall = evaluation::recall_of(row.errors);
    ordered_json shares = ordered_json::array();
    for (std::size_t g = 0; g < evaluation::kRecallGates_deg.size(); ++g) {
      shares.push_back(
          {{"gate_deg", evaluation::kRecallGates_deg[g]}, {"recall", recall.recall[g]}});
    }
    list.push_back({{"method", row.method},
                    {"input", row.input},
                    {"pictures", recall.pictures},
                    {"distances_m", evaluation::kRecallDistances_m},
                    {"gates", std::move(shares)},
                    {"located_0.5m_15deg", recall.located},
                    {"median_m", recall.median_m},
                    {"median_deg", deg_from_rad(recall.median_rad)},
                    {"mean_probability",
                     claims(row) ? ordered_json(recall.mean_probability) : ordered_json()}});
  }
  fmt::print("{}\n", ordered_json{{"map", floors[0]->id()}, {"rows", std::move(list)}}.dump(2));
}

void print_table(const std::vector<Row>& rows) {
  fmt::print(
      "method   input        count   gate       0.1 m   0.25 m    0.5 m      1 m  "
      "  median  heading  0.5 m, 15°  claimed\n");
  for (const Row& row : rows) {
    const evaluation::PlaceRecall recall = evaluation::recall_of(row.errors);
    for (std::size_t g = 0; g < evaluation::kRecallGates_deg.size(); ++g) {
      const double gate_deg = evaluation::kRecallGates_deg[g];
      const auto& share = recall.recall[g];
      fmt::print("{:<8} {:<12} {:>5}  {:>7}  {:>7.1f}% {:>7.1f}% {:>7.1f}% {:>7.1f}%",
                 g == 0 ? row.method : "",
                 g == 0 ? row.input : "",
                 g == 0 ? fmt::format("{}", recall.pictures) : "",
                 gate_deg == 180.0 ? "none" : fmt::format("{:g} deg", gate_deg),
                 100.0 * share[0],
                 100.0 * share[1],
                 100.0 * share[2],
                 100.0 * share[3]);
      if (g == 0) {
        fmt::print("  {:>6.3f} m {:>7.2f}°  {:>9.1f}% {:>8}",
                   recall.median_m,
                   deg_from_rad(recall.median_rad),
                   100.0 * recall.located,
                   claims(row) ? fmt::format("{:.1f}%", 100.0 * recall.mean_probability) : "-");
      }
      fmt::print("\n");
    }
  }
  fmt::print("claimed: mean probability that a method gives the place it names\n{}",
             printed_by_others());
}

Status check(const CLI::App& verb, const Options& options) {
  const auto refuse = [](const char* option, const std::string& message) {
    return fail(Error{ErrorCode::kInvalidArgument, message, option});
  };
  if (options.list.empty() == options.simulated.world.empty()) {
    return refuse("--list", "give the pictures with either --list or --world");
  }
  for (const char* option : {"--world-ground", "--camera-height", "--pictures"}) {
    if (options.list.empty() || verb.count(option) == 0) continue;
    return refuse(option, std::string(option) + ": needs --world");
  }
  const Status valid = places::validate(options.search);
  if (!valid) return refuse("--kappa", valid.error().message);
  if (!options.segment.empty() && options.list.empty()) {
    return refuse("--segment", "--segment: labels the photographs of a --list");
  }
  if (!options.camera.empty() && options.segment.empty()) {
    return refuse("--camera", "--camera: needs --segment, which labels what the rig took");
  }
  return {};
}

Status run(const CLI::App& verb, const Options& options) {
  SEMVIEW_TRY_STATUS(check(verb, options));
  std::optional<PhotoLabeller> labeller;
  if (!options.segment.empty()) {
    SEMVIEW_TRY(labeller, open_photo_labeller(options.segment, options.camera));
  }
  SEMVIEW_TRY(map::SemanticMap drawing,
              map::load_map(options.floors.site.map, {options.floors.site.nearest_colour}));
  SimulatedPictures simulated = options.simulated;
  simulated.searched = drawing.fingerprint;
  SEMVIEW_TRY(const map::SemanticMap map, emptied(options, std::move(drawing)));
  SEMVIEW_TRY(const Floors floors, open_floors(options.floors, map));
  const PanoramaCamera& profile = floors[0]->profile().camera;
  SEMVIEW_TRY(
      const std::vector<KnownPicture> pictures,
      options.list.empty()
          ? simulate_pictures(simulated, floors[0]->cells(), profile)
          : read_picture_list(
                options.list, floors[0]->cells(), profile, labeller ? &*labeller : nullptr));
  SEMVIEW_TRY(const std::vector<Row> rows, evaluate(options, floors, pictures));
  if (options.json) {
    print_json(floors, rows);
  } else {
    print_table(rows);
  }
  return {};
}

void add_simulation_options(CLI::App& verb, Options& options) {
  verb.add_option(
          "--world",
          options.simulated.world,
          "Instead of a list: simulate photographs in this map of the same building, a mesh "
          "mostly")
      ->type_name("MAP");
  verb.add_option("--world-ground", options.simulated.world_ground_m, "The storey's floor in it")
      ->type_name("METRES")
      ->capture_default_str();
  verb.add_option(
          "--camera-height", options.simulated.eye_height_m, "Of the simulated camera, ± 5 cm")
      ->type_name("METRES")
      ->capture_default_str();
  verb.add_option("--pictures", options.simulated.pictures, "How many")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  verb.add_option("--seed", options.simulated.seed, "Of places and errors")->capture_default_str();
  verb.add_option("--missing", options.missing_share, "Share of the map's furniture to leave out")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
}

}  // namespace

void add_evaluate_images(CLI::App& evaluate_verb, int& exit_code) {
  CLI::App* verb = evaluate_verb.add_subcommand(
      "images",
      "How often single pictures are put where they were taken: recall at 0.1, 0.25, 0.5 and 1 m "
      "with no, 30, 10 and 5 degrees of heading error allowed, beside a naive matcher (classes of "
      "the same name or synonyms count 1, best cell and heading) and printed figures of others.");
  const auto options = std::make_shared<Options>();
  add_eye_height_options(*verb, options->floors);
  verb->remove_option(verb->get_option("map"));  // named by --map, as `evaluate logs` has it
  verb->add_option("--map", options->floors.site.map, "Map folder, map.yaml, .glb or .vdb")
      ->type_name("MAP")
      ->required();
  verb->add_option("--list",
                   options->list,
                   "Lines of picture,x_m,y_m,yaw_deg: observation folders, or photographs with "
                   "--segment")
      ->type_name("FILE.csv");
  verb->add_option(
          "--segment",
          options->segment,
          "Label the list's photographs with this network, as `semview observe` does: a "
          "shipped model's name, for example deeplab_ade20k32, or a folder with model.yaml")
      ->type_name("MODEL");
  verb->add_option("--camera",
                   options->camera,
                   "The rig that took them; default: each is one level equirectangular photograph")
      ->type_name("RIG.yaml");
  add_simulation_options(*verb, *options);
  add_weights_option(*verb, options->weights);
  verb->add_flag("--crops", options->crops, "Also four crops of 90 degrees of each panorama");
  verb->add_option("--kappa", options->search.kappa, "Weight of the score in a probability")
      ->capture_default_str();
  verb->add_flag("--json", options->json, "Print JSON");
  verb->footer(
      "Example: semview evaluate images --map maps/duplex_level1 --world maps/duplex_building "
      "--pictures 100");
  verb->callback([verb, options, &exit_code] { exit_code = report(run(*verb, *options)); });
}

}  // namespace semview::cli
