// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "map_box.hpp"
#include "map_verbs.hpp"
#include "semview/map/map_checker.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

struct Options {
  std::vector<std::string> maps;
  map::CheckOptions check;
  bool json = false;
};

nlohmann::json to_json(const map::MapProblem& problem) {
  nlohmann::json json{{"severity", problem.severity == map::Severity::kError ? "error" : "warning"},
                      {"file", problem.file.string()},
                      {"message", problem.message},
                      {"remedy", problem.remedy}};
  if (problem.line > 0) json["line"] = problem.line;
  if (problem.pixel) json["pixel"] = {{"x", problem.pixel->column}, {"y", problem.pixel->row}};
  if (problem.feature) json["feature"] = problem.feature->number;
  return json;
}

void print_text(const std::string& path, const map::MapCheck& check) {
  for (const map::MapProblem& problem : check.report.problems) {
    fmt::print("{}\n", to_string(problem));
  }
  const std::size_t errors = check.report.count(map::Severity::kError);
  const std::size_t warnings = check.report.count(map::Severity::kWarning);
  std::string size;
  if (check.map) {
    const Box box = box_of(*check.map);
    const Eigen::Vector3d extent_m = box.high - box.low;
    size = fmt::format("; {:.2f} x {:.2f} x {:.2f} m", extent_m.x(), extent_m.y(), extent_m.z());
  }
  fmt::print("{}: {}{} error{}, {} warning{}{}\n",
             path,
             errors == 0 ? "ok, " : "",
             errors,
             errors == 1 ? "" : "s",
             warnings,
             warnings == 1 ? "" : "s",
             size);
}

/// `check_map` cannot cast rays, which a mesh's free space takes.
void check_mesh_space(const std::filesystem::path& path,
                      double eye_height_m,
                      map::MapCheck& check) {
  if (!check.map || check.map->mesh() == nullptr) return;
  const Result<map::CellGrid> grid = cell_grid_of(*check.map, eye_height_m);
  if (grid) {
    check_free_space(*grid, *check.map, eye_height_m, check.report);
  } else {
    check.report.problems.push_back(map::problem_of(path, grid.error()));
  }
}

int check_maps(const Options& options) {
  std::vector<std::filesystem::path> paths(options.maps.begin(), options.maps.end());
  std::vector<map::MapCheck> checks;
  for (const std::filesystem::path& path : paths) {
    checks.push_back(map::check_map(path, options.check));
    check_mesh_space(path, options.check.eye_height_m, checks.back());
  }
  check_unique_ids(paths, checks);
  for (map::MapCheck& check : checks) sort_by_place(check.report);
  bool errors = false;
  nlohmann::json list = nlohmann::json::array();
  for (std::size_t i = 0; i < checks.size(); ++i) {
    const map::MapReport& report = checks[i].report;
    errors = errors || report.has_errors();
    if (!options.json) {
      print_text(options.maps[i], checks[i]);
      continue;
    }
    nlohmann::json problems = nlohmann::json::array();
    for (const map::MapProblem& problem : report.problems) problems.push_back(to_json(problem));
    list.push_back({{"map", options.maps[i]},
                    {"ok", !report.has_errors()},
                    {"problems", std::move(problems)}});
  }
  if (options.json) {
    fmt::print("{}\n", list.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  }
  return errors ? kExitFailed : 0;
}

}  // namespace

void add_map_check(CLI::App& map, int& exit_code) {
  CLI::App* verb = map.add_subcommand(
      "check",
      "List everything that is wrong with maps, each with file, line or pixel, what is wrong and "
      "what would be right. Exit code 1 if there is an error, 0 if there are only warnings.");
  const auto options = std::make_shared<Options>();
  verb->add_option("MAP", options->maps, "Map folders, map.yaml, .glb or .vdb files")->required();
  verb->add_option("--eye-height",
                   options->check.eye_height_m,
                   "Metres above the ground; slabs below it block free space")
      ->check(CLI::Range(0.05, 100.0))
      ->capture_default_str();
  add_nearest_colour(*verb, options->check.load);
  verb->add_flag("--json", options->json, "Print the report as JSON");
  verb->footer("Example: semview map check maps/tutorial maps/duplex_level1");
  verb->callback([options, &exit_code] { exit_code = check_maps(*options); });
}

}  // namespace semview::cli
