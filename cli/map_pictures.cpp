// SPDX-License-Identifier: Apache-2.0
/// `semview map preview` and `semview map occupancy`.
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "map_verbs.hpp"
#include "plan_backdrop.hpp"
#include "semview/field/vdb_file.hpp"
#include "semview/io/output_path.hpp"
#include "semview/io/png.hpp"
#include "semview/map/occupancy.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/picture/class_plan_picture.hpp"
#include "verb.hpp"
#include "volume_plan.hpp"

namespace semview::cli {
namespace {

struct Options {
  std::string map;
  std::string output;
  map::LoadOptions load;
  double height_m = 1.2;
};

/// Of a fused map: what is higher is not shown, so that ceilings do not cover the rooms.
constexpr double kTopOfVolume_m = 2.0;

/// A drawn map in its own colours, a fused one by the classes of its volume, a mesh by its free
/// cells.
Result<picture::ClassPlanPicture> picture_of(const map::SemanticMap& map) {
  picture::ClassPlanPicture drawing;
  drawing.title = map.name;
  if (!map.volume.empty()) {
    SEMVIEW_TRY(const field::StoredVolume stored, field::read_vdb(map.volume));
    drawing = volume_plan(stored.volume, map.ground_height_m, kTopOfVolume_m);
    drawing.title = map.name;
    if (!drawing.classes.empty() && !drawing.plan.image.empty()) return drawing;
  }
  if (map.columns() == nullptr) {
    SEMVIEW_TRY(drawing.plan, free_cells_plan(map));
    drawing.classes.push_back({kFreeColour, "free"});
    return drawing;
  }
  const map::ColumnMap& columns = *map.columns();
  drawing.plan = {plan_image(map, columns), columns.resolution_m, columns.origin};
  for (const map::MapClass& details : map.class_details) {
    if (!details.color) continue;
    drawing.classes.push_back({*details.color, details.name});
    drawing.classes.push_back({map::object_color(*details.color), details.name + ", as an object"});
  }
  return drawing;
}

Status preview(const Options& options) {
  SEMVIEW_TRY_STATUS(io::check_output_png(options.output));
  SEMVIEW_TRY(const map::SemanticMap map, map::load_map(options.map, options.load));
  SEMVIEW_TRY(const picture::ClassPlanPicture drawing, picture_of(map));
  SEMVIEW_TRY_STATUS(io::write_png(options.output, draw_class_plan(drawing)));
  const picture::Plan& plan = drawing.plan;
  fmt::print("{}: a plan of {:.1f} x {:.1f} m\n",
             options.output,
             plan.image.columns() * plan.resolution_m,
             plan.image.rows() * plan.resolution_m);
  return {};
}

Status occupancy(const Options& options) {
  if (!options.output.empty()) SEMVIEW_TRY_STATUS(io::check_output_png(options.output));
  SEMVIEW_TRY(const map::SemanticMap map, map::load_map(options.map, options.load));
  if (map.columns() == nullptr) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("{}: is a mesh map, which has no drawing and so no resolution "
                                  "and origin for an occupancy image",
                                  options.map),
                      {},
                      "`semview map preview` shows its free cells"});
  }
  const std::string output =
      options.output.empty() ? (map.directory / "occupancy.png").string() : options.output;
  SEMVIEW_TRY_STATUS(io::write_png(output, occupancy_image(*map.columns(), options.height_m)));
  fmt::print("{}: {} x {} pixels\n", output, map.columns()->columns(), map.columns()->rows());
  return {};
}

void add_common(CLI::App& verb, Options& options) {
  verb.add_option("MAP", options.map, "Map folder, map.yaml, .glb or .vdb")->required();
  add_nearest_colour(verb, options.load);
}

}  // namespace

void add_map_pictures(CLI::App& map, int& exit_code) {
  CLI::App* preview_verb = map.add_subcommand(
      "preview",
      "Draw a plan in its classes' colours as semview reads it, outside in white, objects with "
      "heights of their own in another shade, with a legend, "
      "metres along the edges and a scale bar. Of a fused map: the classes of its volume seen from "
      "above, up to 2 m. Of another mesh: the free cells.");
  const auto preview_options = std::make_shared<Options>();
  add_common(*preview_verb, *preview_options);
  preview_verb->add_option("-o,--output", preview_options->output, "PNG to write")->required();
  preview_verb->footer("Example: semview map preview maps/duplex_level1 -o plan.png");
  preview_verb->callback(
      [preview_options, &exit_code] { exit_code = report(preview(*preview_options)); });

  CLI::App* verb = map.add_subcommand(
      "occupancy",
      "Draw the grey image that a map.yaml names for ROS tools: black is what a robot of the given "
      "height would hit, white is free, grey is outside.");
  const auto options = std::make_shared<Options>();
  add_common(*verb, *options);
  verb->add_option(
      "-o,--output", options->output, "PNG to write; occupancy.png beside the map.yaml if absent");
  verb->add_option("--height", options->height_m, "The robot's height in metres")
      ->check(CLI::Range(0.05, 100.0))
      ->capture_default_str();
  verb->footer("Example: semview map occupancy maps/tutorial");
  verb->callback([options, &exit_code] { exit_code = report(occupancy(*options)); });
}

}  // namespace semview::cli
