// SPDX-License-Identifier: Apache-2.0
/// `semview evaluate sketches`.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "evaluate_verbs.hpp"
#include "experiments/paper2017/sketch_drives.hpp"
#include "experiments/paper2017/sketch_picture.hpp"
#include "experiments/paper2017/sketch_records.hpp"
#include "experiments/paper2017/sketch_report.hpp"
#include "semview/io/png.hpp"
#include "semview/io/text_file.hpp"
#include "site_options.hpp"
#include "stop_signals.hpp"
#include "threads_option.hpp"
#include "verb.hpp"
#include "world_list.hpp"

namespace semview::cli {
namespace {

using paper2017::SketchDrive;
using paper2017::SketchSettings;
using paper2017::Start;

struct Options {
  SketchSettings settings;
  std::string worlds;
  std::vector<std::string> starts{"local", "global"};
  std::string out = "sketch_results";
  bool json = false;
};

/// The last method's first drive on the first sketch of each world.
Status draw_pictures(const SketchSettings& settings, const std::vector<SketchDrive>& drives) {
  for (const std::uint64_t world : settings.worlds) {
    const SketchDrive* shown = nullptr;
    for (const SketchDrive& drive : drives) {
      if (drive.world != world || drive.sketch != 1 || drive.run != 1 ||
          drive.start != settings.starts.front() || drive.method == paper2017::kOdometryAlone) {
        continue;
      }
      shown = &drive;
    }
    if (shown == nullptr) continue;
    SEMVIEW_TRY(const RgbImage picture, paper2017::draw_sketch_drive(settings, *shown));
    SEMVIEW_TRY_STATUS(io::write_png(settings.out / fmt::format("world_{}.png", world), picture));
  }
  return {};
}

void print_json(const std::vector<paper2017::SketchSummary>& summaries) {
  using nlohmann::ordered_json;
  ordered_json rows = ordered_json::array();
  for (const paper2017::SketchSummary& one : summaries) {
    rows.push_back({{"method", one.method},
                    {"start", paper2017::name(one.start)},
                    {"drives", one.drives},
                    {"stops", one.stops},
                    {"right_room", one.right_room_share},
                    {"right_room_from_image_4", one.late_share},
                    {"right_room_in_worst_world", one.worst_world_share},
                    {"rooms_in_order", one.right_order_share},
                    {"mean_error_m", one.mean_error_m},
                    {"median_error_m", one.median_error_m}});
  }
  fmt::print("{}\n", ordered_json{{"rows", std::move(rows)}}.dump(2));
}

Status evaluate_sketches(const Options& options) {
  SketchSettings settings = options.settings;
  SEMVIEW_TRY(settings.worlds, parse_worlds(options.worlds));
  settings.out = options.out;
  settings.starts.clear();
  for (const std::string& start : options.starts) {
    settings.starts.push_back(start == "local" ? Start::kLocal : Start::kGlobal);
  }
  say_when_stopped(
      fmt::format("stopped; sketches that were done are kept in {}: go on with --resume",
                  (settings.out / "units").string()));
  SEMVIEW_TRY(const std::vector<SketchDrive> drives,
              paper2017::drive_sketches(settings, [](std::size_t done, std::size_t all) {
                fmt::print(stderr, "[{}/{}] sketches\n", done, all);
              }));
  const std::vector<paper2017::SketchSummary> summaries = paper2017::summarize(drives);
  const std::string table = paper2017::to_markdown(summaries);
  SEMVIEW_TRY_STATUS(io::write_text_file(settings.out / "sketches.md", table));
  SEMVIEW_TRY_STATUS(
      io::write_text_file(settings.out / "sketch_stops.csv", paper2017::to_csv(drives)));
  SEMVIEW_TRY_STATUS(draw_pictures(settings, drives));
  if (options.json) {
    print_json(summaries);
  } else {
    fmt::print("{}", table);
  }
  return {};
}

}  // namespace

void add_evaluate_sketches_verb(CLI::App& evaluate, int& exit_code) {
  CLI::App* verb = evaluate.add_subcommand(
      "sketches",
      "Robots in generated buildings, localized on sketches of them: rooms stretched by 0.7 to "
      "1.4, "
      "ends of walls 0.3 to 0.8 m off, walls and furniture missing or swapped. Prints how many "
      "stops are put into the right room and whether rooms come in the right order; writes "
      "sketches.md, sketch_stops.csv and a picture a world. See experiments/paper2017/README.md.");
  const auto options = std::make_shared<Options>();
  SketchSettings& settings = options->settings;
  options->worlds = world_list(settings.worlds);
  verb->add_option("--worlds", options->worlds, "1..100 for results, 201..205 to choose settings")
      ->type_name("A..B,C,...")
      ->capture_default_str();
  verb->add_option("--sketches", settings.sketches, "Sketches of each world")
      ->capture_default_str();
  verb->add_option("--runs", settings.runs, "Filter seeds a sketch")->capture_default_str();
  verb->add_option("--seed", settings.seed, "Seed of sketches and filters")->capture_default_str();
  add_threads_option(*verb, settings.threads);
  verb->add_option("--methods", settings.methods, "Some of weighted, none, global, local")
      ->type_name("METHOD,...")
      ->delimiter(',');
  verb->add_option("--starts", options->starts, "Known start, unknown start or both")
      ->type_name("local,global")
      ->check(CLI::IsMember({"local", "global"}))
      ->delimiter(',');
  add_engine_option(*verb, settings.engine);
  verb->add_flag("--resume", settings.resume, "Keep what is finished in --out");
  verb->add_option("-o,--out", options->out, "Folder of the results")->capture_default_str();
  verb->add_flag("--json", options->json, "Print the table as JSON");
  verb->footer("Example: semview evaluate sketches --worlds 1..2 --runs 1 -o sketches");
  verb->callback([options, &exit_code] { exit_code = report(evaluate_sketches(*options)); });
}

}  // namespace semview::cli
