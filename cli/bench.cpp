// SPDX-License-Identifier: Apache-2.0
/// `semview bench`: the claims of speed, measured here and now; and `semview bench growth`.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "bench_served.hpp"
#include "bench_verbs.hpp"
#include "semview/benchmark/growth.hpp"
#include "semview/benchmark/suite.hpp"
#include "semview/core/version.hpp"
#include "semview/io/output_path.hpp"
#include "semview/io/text_file.hpp"
#include "site_options.hpp"
#include "stop_signals.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

using benchmark::Row;
using nlohmann::ordered_json;

struct Options {
  std::vector<std::string> maps;
  benchmark::SuiteConfig suite;
  bool json = false;
  bool markdown = false;
  bool list = false;
};

ordered_json to_json(const Row& row) {
  ordered_json json = {{"id", row.id},
                       {"claim", row.claim},
                       {"plan", row.subject},
                       {"size", row.size},
                       {"threads", row.threads},
                       {"goal", row.goal.text}};
  if (!row.engine.empty()) {
    json["engine"] = row.engine;
    json["engine_reason"] = row.engine_reason;
  }
  if (row.found) {
    const benchmark::Finding& found = *row.found;
    json["unit"] = found.unit;
    json["ours"] = found.ours;
    json["ours_median"] = found.ours_median;
    json["other"] = found.other;
    json["other_median"] = found.other_median;
    json["ratio"] = found.ratio;
    json["ratio_median"] = found.ratio_median;
    json["rounds"] = found.rounds;
    if (!found.clock.empty()) json["clock"] = found.clock;
    json["agreement"] = found.agreement;
  }
  if (const auto reached = row.reached()) json["reached"] = *reached;
  if (const auto then = row.reached_then()) json["reached_then"] = *then;
  if (!row.note.empty()) json["note"] = row.note;
  if (row.failed) json["failed"] = true;
  if (row.disagrees) json["disagrees"] = true;
  return json;
}

void show_progress(const benchmark::Progress& progress) {
  if (isatty(STDERR_FILENO) == 0) {
    if (progress.done == 0) {
      fmt::print(stderr, "{} rows, about {:.0f} s\n", progress.rows, progress.remaining_s);
    }
    return;
  }
  fmt::print(stderr,
             "\r\033[K[{}/{}] {} on {}; about {:.0f} s left",
             progress.done + 1,
             progress.rows,
             progress.next->claim,
             progress.next->subject,
             progress.remaining_s);
}

/// What results that differ say comes before what could not be measured.
Status first_failure(const std::vector<Row>& rows) {
  auto worst = std::ranges::find_if(rows, &Row::disagrees);
  if (worst == rows.end()) worst = std::ranges::find_if(rows, &Row::failed);
  if (worst == rows.end()) return {};
  return fail(
      worst->disagrees ? ErrorCode::kInternal : ErrorCode::kUnavailable,
      fmt::format("{} on {} at {}: {}", worst->id, worst->subject, worst->size, worst->note));
}

Status run(const Options& options) {
  if (options.list) {
    for (const benchmark::Claim& claim : benchmark::claims()) {
      fmt::print("{:<18} {}\n", claim.id, claim.text);
    }
    return {};
  }
  benchmark::SuiteConfig config = options.suite;
  config.maps.assign(options.maps.begin(), options.maps.end());
  config.serve = serve_on_loopback();
  config.stopped = stop_asked;
  ask_to_stop_on_signals();  // or files that are being measured would stay behind
  const auto rows = benchmark::run_suite(config, show_progress);
  if (isatty(STDERR_FILENO) != 0) fmt::print(stderr, "\r\033[K");
  if (!rows) return fail(rows.error());
  if (options.json) {
    ordered_json json = {
        {"version", kVersion}, {"engine", config.engine}, {"rows", ordered_json::array()}};
    for (const Row& row : *rows) json["rows"].push_back(to_json(row));
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("{}", options.markdown ? benchmark::to_markdown(*rows) : benchmark::to_text(*rows));
  }
  if (stop_asked()) {
    return fail(ErrorCode::kCancelled, fmt::format("interrupted after {} rows", rows->size()));
  }
  return first_failure(*rows);
}

struct GrowthOptions {
  std::string csv;
  std::string svg;
  bool quick = false;
};

Status run_growth(const GrowthOptions& options) {
  for (const std::string& file : {options.csv, options.svg}) {
    if (!file.empty()) SEMVIEW_TRY_STATUS(io::check_output_file(file));
  }
  benchmark::GrowthConfig config;
  config.quick = options.quick;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  SEMVIEW_TRY(const std::vector<benchmark::GrowthPoint> points,
              benchmark::measure_growth(config, [terminal](std::size_t done, std::size_t all) {
                if (terminal) fmt::print(stderr, "\r\033[K[{}/{}]", done + 1, all);
              }));
  if (terminal) fmt::print(stderr, "\r\033[K");
  const std::string csv = benchmark::to_csv(points);
  if (!options.svg.empty()) SEMVIEW_TRY_STATUS(benchmark::write_growth_svg(options.svg, points));
  if (!options.csv.empty()) return io::write_text_file(options.csv, csv);
  fmt::print("{}", csv);
  return {};
}

void add_growth_verb(CLI::App& bench, int& exit_code) {
  CLI::App* growth = bench.add_subcommand(
      "growth",
      "How the costs of a view grow with the size of the plan, its resolution, its classes and "
      "the size of the panorama: CSV, and a plot. Takes about a minute.");
  const auto options = std::make_shared<GrowthOptions>();
  growth->add_option("-o,--output", options->csv, "CSV file to write; default: print it");
  growth->add_option("--svg", options->svg, "Plot to write");
  growth->add_flag("--quick", options->quick, "Two small values of each; the times say nothing");
  growth->footer("Example: semview bench growth -o growth.csv --svg growth.svg");
  growth->callback([options, &exit_code] { exit_code = report(run_growth(*options)); });
}

}  // namespace

void add_bench_verb(CLI::App& app, int& exit_code) {
  CLI::App* bench = app.add_subcommand(
      "bench",
      "Measure what semview claims, each row beside its alternative: in turn, in one process, the "
      "least time of each and the median in brackets. Results are compared before anything is "
      "timed: where they should be equal and are not, the program fails; where another method sees "
      "differently (points, numpy), the share that is equal stands beside the ratio. On a busy "
      "machine read the ratios.");
  const auto options = std::make_shared<Options>();
  bench->add_option("maps", options->maps, "Maps to measure besides the generated offices")
      ->type_name("MAP...");
  bench->add_option("--only", options->suite.only, "Rows, comma-separated; --list names them")
      ->type_name("ROW,...")
      ->delimiter(',');
  bench->add_option("--threads", options->suite.threads, "Threads, one row each")
      ->type_name("N,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  bench->add_flag("--quick",
                  options->suite.quick,
                  "A small plan, one round: whether results agree; its times say nothing");
  bench->add_flag("--list", options->list, "List the rows");
  add_engine_option(*bench, options->suite.engine);
  auto* json = bench->add_flag("--json", options->json, "Print JSON");
  bench->add_flag("--markdown", options->markdown, "Print a table for Markdown")->excludes(json);
  bench->footer("Example: semview bench maps/duplex_level1 --only single,compass --threads 1");
  add_growth_verb(*bench, exit_code);
  add_bench_load_verb(*bench, exit_code);
  bench->require_subcommand(0, 1);
  // The table, unless a verb of its own was asked for.
  bench->callback([bench, options, &exit_code] {
    if (bench->get_subcommands().empty()) exit_code = report(run(*options));
  });
}

}  // namespace semview::cli
