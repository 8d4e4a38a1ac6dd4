// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "map_verbs.hpp"
#include "semview/io/output_path.hpp"
#include "semview/map/plan_import.hpp"
#include "semview/map/ros_import.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

struct Options {
  std::string input;
  std::string output;
  map::RosImportConfig ros;
};

template <typename Import>
int import_into(const Options& options, const Import& import_map) {
  Status status = io::check_output_folder(options.output);
  if (status) status = import_map(options);
  if (status) fmt::print("{}: written; `semview map check {}`\n", options.output, options.output);
  return report(status);
}

}  // namespace

void add_map_import(CLI::App& map, int& exit_code) {
  CLI::App* import_verb =
      map.add_subcommand("import", "Make a map folder from a map or plan of another kind.");
  import_verb->require_subcommand(1);

  CLI::App* ros = import_verb->add_subcommand(
      "ros",
      "Make a map of walls and floor from a ROS map_server map (modes trinary, scale and raw; PGM "
      "or PNG): occupied cells become wall, free ones floor, unknown ones outside.");
  const auto ros_options = std::make_shared<Options>();
  ros->add_option("MAP.yaml", ros_options->input, "The map_server file")->required();
  ros->add_option("-o,--output", ros_options->output, "Folder to make")->required();
  ros->add_option("--wall-height", ros_options->ros.wall_height_m, "Metres; the ceiling's too")
      ->capture_default_str();
  ros->footer("Example: semview map import ros warehouse.yaml -o maps/warehouse");
  ros->callback([ros_options, &exit_code] {
    exit_code = import_into(*ros_options, [](const Options& options) {
      return map::import_ros_map(options.input, options.output, options.ros);
    });
  });

  CLI::App* plan = import_verb->add_subcommand(
      "plan",
      "Make a map from a colour-coded plan with a YAML list of rgb, z_min and z_max a class "
      "(docs/formats/map_bundle.md). Class unknown becomes outside; cabinets stand under "
      "countertops.");
  const auto plan_options = std::make_shared<Options>();
  plan->add_option("FILE.yaml", plan_options->input, "The plan's file")->required();
  plan->add_option("-o,--output", plan_options->output, "Folder to make")->required();
  plan->footer("Example: semview map import plan plan_level1.yaml -o maps/level1");
  plan->callback([plan_options, &exit_code] {
    exit_code = import_into(*plan_options, [](const Options& options) {
      return map::import_plan(options.input, options.output);
    });
  });
}

}  // namespace semview::cli
