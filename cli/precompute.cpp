// SPDX-License-Identifier: Apache-2.0
#include "semview/service/precompute.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "duration_text.hpp"
#include "semview/cache/lmdb_store.hpp"
#include "semview/service/site.hpp"
#include "site_options.hpp"
#include "stop_signals.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

struct Options {
  SiteOptions site;
  std::string region;
  std::string reachable_from;
  bool dry_run = false;
  bool json = false;
};

std::string bytes_text(std::uint64_t bytes) {
  const auto value = static_cast<double>(bytes);
  if (value < 1e6) return fmt::format("{:.1f} kB", value / 1e3);
  if (value < 1e9) return fmt::format("{:.1f} MB", value / 1e6);
  return fmt::format("{:.2f} GB", value / 1e9);
}

nlohmann::json to_json(const char* event, const service::PrecomputeProgress& progress) {
  // Nothing cast yet, nothing known.
  const bool known = progress.cast > 0 || progress.found == progress.cells;
  const nlohmann::json remaining = known ? nlohmann::json(progress.remaining_s) : nullptr;
  return {{"event", event},
          {"cells", progress.cells},
          {"found", progress.found},
          {"cast", progress.cast},
          {"record_bytes", progress.bytes},
          {"elapsed_s", progress.elapsed_s},
          {"views_per_s", progress.views_per_s},
          {"remaining_s", remaining}};
}

/// Shows progress: one line that is written over on a terminal, else a JSON line at most every
/// half second.
class ProgressLine {
 public:
  explicit ProgressLine(bool on_terminal) : on_terminal_(on_terminal) {}

  void show(const service::PrecomputeProgress& progress) {
    const bool last = progress.found + progress.cast == progress.cells;
    if (!on_terminal_) {
      if (!last && progress.elapsed_s < next_s_) return;
      next_s_ = progress.elapsed_s + 0.5;
      fmt::print("{}\n", to_json("progress", progress).dump());
      std::fflush(stdout);
      return;
    }
    constexpr std::size_t kWidth = 30;
    const std::size_t done = progress.found + progress.cast;
    const std::size_t filled = progress.cells == 0 ? kWidth : kWidth * done / progress.cells;
    fmt::print("\r[{}{}] {} of {} views, {:.0f} a second, {} left   ",
               std::string(filled, '#'),
               std::string(kWidth - filled, '.'),
               done,
               progress.cells,
               progress.views_per_s,
               duration_text(progress.remaining_s));
    std::fflush(stdout);
  }
  void finish() const {
    if (on_terminal_) fmt::print("\n");
  }

 private:
  bool on_terminal_;
  double next_s_ = 0.0;
};

Result<service::PrecomputeRegion> read_region(const Options& options) {
  service::PrecomputeRegion region;
  if (!options.region.empty()) {
    SEMVIEW_TRY(const std::vector<double> numbers, parse_numbers("--region", options.region, 4));
    region.rectangle_m = {numbers[0], numbers[1], numbers[2], numbers[3]};
  }
  if (!options.reachable_from.empty()) {
    SEMVIEW_TRY(const std::vector<double> numbers,
                parse_numbers("--reachable-from", options.reachable_from, 2));
    region.reachable_from_m = {numbers[0], numbers[1]};
  }
  return region;
}

Status dry_run(const service::Site& site, const service::PrecomputePlan& plan, bool as_json) {
  SEMVIEW_TRY(const service::PrecomputeEstimate estimate, service::estimate_precompute(site, plan));
  if (as_json) {
    const nlohmann::json json = {{"map", site.id()},
                                 {"engine", site.engine().name},
                                 {"engine_reason", site.engine().reason},
                                 {"free_cells", plan.free_cells},
                                 {"cells", estimate.cells},
                                 {"found", estimate.found},
                                 {"sampled", estimate.sampled},
                                 {"estimated_s", estimate.seconds},
                                 {"estimated_bytes", estimate.bytes}};
    fmt::print("{}\n", json.dump(2));
    return {};
  }
  fmt::print("{}: {} views for {} free cells, {} of them stored already\n",
             site.id(),
             estimate.cells,
             plan.free_cells,
             estimate.found);
  fmt::print("estimate for the rest, from {} views cast now: {} on {} threads, {} on disk\n",
             estimate.sampled,
             duration_text(estimate.seconds),
             site.pool().threads(),
             bytes_text(estimate.bytes));
  return {};
}

void show_end(const service::Site& site,
              const service::PrecomputeResult& result,
              bool on_terminal) {
  const service::PrecomputeProgress& progress = result.progress;
  const bool complete = result.end == service::PrecomputeEnd::kComplete;
  if (!on_terminal) {
    nlohmann::json json = to_json(complete ? "complete" : "stopped", progress);
    json["map"] = site.id();
    json["engine"] = site.engine().name;
    json["engine_reason"] = site.engine().reason;
    json["file_bytes"] = site.tiers().store->file_bytes();
    fmt::print("{}\n", json.dump());
  } else {
    fmt::print("{}: {} views cast ({:.0f} a second), {} found stored; the cache holds {}\n",
               site.id(),
               progress.cast,
               progress.views_per_s,
               progress.found,
               bytes_text(site.tiers().store->file_bytes()));
  }
  if (!complete) {
    fmt::print(stderr,
               "semview: stopped with {} of {} views stored\n"
               "  run the same command again to go on; nothing is cast twice\n",
               progress.found + progress.cast,
               progress.cells);
  }
}

/// The program's exit code.
Result<int> run(const Options& options) {
  if (options.site.cache_directory.empty() && !options.dry_run) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      "precompute needs a directory to store views in",
                      "--cache",
                      "name one: --cache DIR"});
  }
  SEMVIEW_TRY(const service::PrecomputeRegion region, read_region(options));
  SiteOptions site_options = options.site;
  std::error_code ignored;
  if (options.dry_run && !std::filesystem::exists(site_options.cache_directory, ignored)) {
    site_options.cache_directory.clear();  // nothing is stored there, and nothing shall be
  }
  SEMVIEW_TRY(const std::shared_ptr<service::Site> site, open_site(site_options));
  SEMVIEW_TRY(const service::PrecomputePlan plan, service::plan_precompute(*site, region));
  if (options.dry_run) {
    SEMVIEW_TRY_STATUS(dry_run(*site, plan, options.json));
    return 0;
  }
  ask_to_stop_on_signals();
  const bool on_terminal = !options.json && isatty(STDOUT_FILENO) == 1;
  ProgressLine line(on_terminal);
  std::stop_source stop;
  Result<service::PrecomputeResult> result = service::run_precompute(
      *site, plan, stop.get_token(), [&](const service::PrecomputeProgress& progress) {
        line.show(progress);
        if (stop_asked()) stop.request_stop();
      });
  line.finish();
  if (!result) return fail(std::move(result).error());
  show_end(*site, *result, on_terminal);
  log_unusable_records(*site, site_options.cache_directory);
  return result->end == service::PrecomputeEnd::kComplete ? 0 : kExitFailed;
}

}  // namespace

void add_precompute_verb(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("precompute", "Cast and store the views of a map ahead");
  verb->description(
      "Casts the panorama of every cell in which a robot may stand (10 cm grid) and stores it in "
      "a\n"
      "cache directory, from which all other verbs and the server take it. Ctrl-C stops cleanly;\n"
      "the same command goes on where it stopped. The stored bytes do not depend on the number of\n"
      "threads. Progress is a line on a terminal, JSON lines (one object a line) otherwise.");
  add_site_options(*verb, options->site);
  add_ranges_option(*verb, options->site);
  verb->add_option("--region", options->region, "Only cells in this rectangle, metres")
      ->type_name("X0,Y0,X1,Y1");
  verb->add_option("--reachable-from",
                   options->reachable_from,
                   "Only cells that a robot can drive to from here, metres")
      ->type_name("X,Y");
  verb->add_flag("--dry-run", options->dry_run, "Say what it would take; store nothing");
  verb->add_flag("--json", options->json, "JSON on a terminal too");
  verb->footer(
      "Example:\n"
      "  semview precompute maps/duplex_level1 --cache cache --dry-run\n"
      "  semview precompute maps/duplex_level1 --cache cache");
  verb->callback([options, &exit_code] {
    const Result<int> code = run(*options);
    exit_code = code ? *code : report(fail(code.error()));
  });
}

}  // namespace semview::cli
