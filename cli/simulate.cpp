// SPDX-License-Identifier: Apache-2.0
/// `semview simulate`.
#include <map>
#include <memory>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "semview/io/output_path.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/simulation/simulator.hpp"
#include "site_options.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

struct Options {
  std::string map;
  std::string world;
  std::string output;
  std::string elevation_deg = "-45,45";
  double field_of_view_deg = 360.0;
  bool nearest_colour = false;
  bool json = false;
  simulation::SimulationConfig config;
};

/// The building to drive in: the map itself, to be varied, or another one, taken as it is.
Result<map::SemanticMap> load_world(const Options& options, simulation::SimulationConfig& config) {
  const map::LoadOptions load{options.nearest_colour};
  SEMVIEW_TRY(map::SemanticMap map, map::load_map(options.map, load));
  if (options.world.empty()) return map;
  config.world = {.height_error_m = 0.0, .missing_share = 0.0};
  SEMVIEW_TRY(map::SemanticMap world, map::load_map(options.world, load));
  return world;
}

/// The module names its own fields; people typed options.
Status check_options(const simulation::SimulationConfig& config) {
  const Status valid = simulation::validate(config);
  if (valid) return {};
  static const std::map<std::string, std::string> kOptions{{"frames", "--steps"},
                                                           {"frame_distance_m", "--frame-distance"},
                                                           {"noise_level", "--noise"},
                                                           {"missing_share", "--missing"},
                                                           {"azimuth_width", "--fov"},
                                                           {"eye_height_m", "--eye-height"}};
  Error error = valid.error();
  const auto known = kOptions.find(error.field);
  if (error.field.starts_with("--")) return fail(std::move(error));
  error.field = known != kOptions.end() ? known->second : "--" + error.field;
  error.message = fmt::format("{}: {}", error.field, error.message);
  return fail(std::move(error));
}

void print_text(const Options& options, const simulation::SimulationReport& run) {
  fmt::print("{}: {} frames over {:.1f} m, {:.0f} s of the robot's time\n",
             options.output,
             run.frames,
             run.way_m,
             run.duration_s);
  fmt::print("  start      {:.3f},{:.3f},{:.1f}  (x m, y m, yaw deg)\n",
             run.start.x_m,
             run.start.y_m,
             deg_from_rad(run.start.yaw_rad));
  fmt::print("  odometry   {:.2f} m off at the end\n", run.odometry_error_m);
  fmt::print("  labels     {:.1f} % wrong\n", 100.0 * run.wrong_label_share);
  fmt::print("  world      {} objects, {} of {} pieces of furniture missing, {} doors opened\n",
             run.objects,
             run.missing,
             run.furniture,
             run.opened_doors);
  fmt::print("  clearance  {:.2f} m at least\n", run.min_clearance_m);
}

void print_json(const Options& options, const simulation::SimulationReport& run) {
  const nlohmann::json json{
      {"out", options.output},
      {"engine", run.engine},
      {"engine_reason", run.engine_reason},
      {"seed", options.config.seed},
      {"frames", run.frames},
      {"way_m", run.way_m},
      {"duration_s", run.duration_s},
      {"start",
       {{"x_m", run.start.x_m}, {"y_m", run.start.y_m}, {"yaw_deg", shown_deg(run.start.yaw_rad)}}},
      {"odometry_error_m", run.odometry_error_m},
      {"wrong_label_share", run.wrong_label_share},
      {"objects", run.objects},
      {"furniture", run.furniture},
      {"missing", run.missing},
      {"opened_doors", run.opened_doors},
      {"min_clearance_m", run.min_clearance_m}};
  fmt::print("{}\n", json.dump(2));
}

Status simulate(const Options& options) {
  simulation::SimulationConfig config = options.config;
  SEMVIEW_TRY(const std::vector<double> elevation,
              parse_numbers("--elevation", options.elevation_deg, 2));
  config.camera.elevation_min_rad = rad_from_deg(elevation[0]);
  config.camera.elevation_max_rad = rad_from_deg(elevation[1]);
  config.camera.azimuth_width_rad = rad_from_deg(options.field_of_view_deg);
  SEMVIEW_TRY_STATUS(check_options(config));
  SEMVIEW_TRY_STATUS(io::check_output_folder(options.output));
  SEMVIEW_TRY(const map::SemanticMap world, load_world(options, config));
  SEMVIEW_TRY(const simulation::SimulationReport run,
              simulation::simulate(world, config, options.output));
  options.json ? print_json(options, run) : print_text(options, run);
  return {};
}

void add_camera_options(CLI::App& verb, Options& options) {
  simulation::CameraConfig& camera = options.config.camera;
  verb.add_option("--eye-height", camera.height_m, "Camera height above the ground in metres")
      ->capture_default_str();
  verb.add_option("--columns", camera.columns, "Pixels of a full turn, a multiple of 120")
      ->capture_default_str();
  verb.add_option("--rows", camera.rows, "Pixels from bottom to top")->capture_default_str();
  verb.add_option("--elevation", options.elevation_deg, "Lower and upper edge in degrees: MIN,MAX")
      ->capture_default_str();
  verb.add_option("--fov",
                  options.field_of_view_deg,
                  "Width of the camera's view in degrees, half of it to either side")
      ->capture_default_str();
}

}  // namespace

void add_simulate_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "simulate",
      "Drive a simulated robot through a building and write the run log that a real one would: "
      "odometry that drifts, label images with the errors of a segmentation network, and the "
      "ground truth. The building differs from the map: objects stand a little higher or lower, "
      "some furniture is missing, the doors that the robot goes through are open.");
  const auto options = std::make_shared<Options>();
  simulation::SimulationConfig& config = options->config;
  verb->add_option("MAP", options->map, "Map folder, map.yaml, .glb or .vdb")->required();
  verb->add_option("--world",
                   options->world,
                   "Drive in this map instead, just as it is drawn, in the frame of MAP");
  verb->add_option("-o,--out", options->output, "Folder of the run log; must not hold one yet")
      ->required();
  verb->add_option("--seed", config.seed, "The same seed gives the same files")
      ->capture_default_str();
  verb->add_option("--steps", config.frames, "Camera frames")->capture_default_str();
  verb->add_option("--frame-distance", config.frame_distance_m, "Metres driven between two frames")
      ->capture_default_str();
  verb->add_option("--noise",
                   config.noise_level,
                   "Scales every error; 0: a perfect robot in a building just as drawn")
      ->capture_default_str();
  verb->add_option("--missing",
                   config.world.missing_share,
                   "Probability that a piece of furniture is missing, before --noise scales it")
      ->capture_default_str();
  add_camera_options(*verb, *options);
  add_engine_option(*verb, config.engine);
  verb->add_flag("--nearest-colour",
                 options->nearest_colour,
                 "Take unknown colours to be the nearest class's");
  verb->add_flag("--json", options->json, "Print the figures of the run as JSON");
  verb->footer("Example: semview simulate maps/duplex_level1 --out run1 --seed 1");
  verb->callback([options, &exit_code] { exit_code = report(simulate(*options)); });
}

}  // namespace semview::cli
