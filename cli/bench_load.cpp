// SPDX-License-Identifier: Apache-2.0
/// `semview bench load`: how many robots a server holds.
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench_verbs.hpp"
#include "client/lib/remote_view_source.hpp"
#include "client/load/dealer_wire.hpp"
#include "client/load/kernel_time.hpp"
#include "client/load/load_work.hpp"
#include "client/load/most_robots.hpp"
#include "client/load/open_loop.hpp"
#include "server/server.hpp"
#include "site_options.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

using client::LoadKind;
using client::LoadReport;
using client::LoadStep;
using nlohmann::ordered_json;

struct Options {
  SiteOptions site;
  std::string server;  ///< empty: one in this process
  client::LoadConfig load;
  std::string kind = "global";
  bool cold = false;
  bool search = false;
  bool json = false;
};

/// A server under load; in this process unless one was named.
struct Target {
  std::string map_id;
  client::ConnectionConfig connection;
  std::unique_ptr<server::Server> server;
  std::size_t threads = 0;  ///< of `server`
};

Result<Target> open_target(const Options& options) {
  Target target;
  target.connection.client_name = "semview bench load";
  target.connection.timeout = std::chrono::seconds(30);
  if (!options.server.empty()) {
    SEMVIEW_TRY_STATUS(client::check_is_this_machine(options.server));
    target.map_id = options.site.map;
    target.connection.endpoint = options.server;
    return target;
  }
  SEMVIEW_TRY(std::shared_ptr<service::Site> site, open_site(options.site));
  target.map_id = site->id();
  target.threads = site->pool().threads();
  service::MapRegistry maps;
  SEMVIEW_TRY_STATUS(maps.add(std::move(site)));
  server::ServerConfig config;
  config.bind = "tcp://127.0.0.1:*";
  config.events = false;
  config.workers = options.site.threads;
  SEMVIEW_TRY(target.server, server::Server::start(config, std::move(maps)));
  target.connection.endpoint = target.server->endpoint();
  return target;
}

/// A search begins no run that could end later than this.
constexpr double kSearchSeconds = 180.0;

struct Findings {
  std::string map_id;
  std::string engine;
  std::size_t threads = 0;  ///< of the server; 0: one in another process, which does not tell
  std::size_t cores = 0;
  client::KernelTime kernel;
  std::vector<LoadStep> steps;
  std::optional<std::size_t> most_robots;
  bool settled = false;

  double ceiling(const Options& options) const {
    return kernel.robots(cores, options.load.rate_hz);
  }
};

Result<LoadReport> load(const Options& options,
                        const Target& target,
                        const client::LoadWork& work) {
  SEMVIEW_TRY(const auto wire,
              client::DealerWire::open(
                  target.connection.endpoint, options.load.robots, options.load.timeout));
  return run_open_loop(options.load, work, *wire, steady_clock());
}

Result<Findings> measure(Options options) {
  const LoadKind kind = options.kind == "global" ? LoadKind::kGlobal : LoadKind::kTracking;
  SEMVIEW_TRY_STATUS(validate(options.load));
  constexpr double kLongestSearchedRun_s = 60.0;
  if (options.search && options.load.seconds > kLongestSearchedRun_s) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("--seconds {:g}: expected at most {:g} with --search, which ends "
                                  "after {:g} s",
                                  options.load.seconds,
                                  kLongestSearchedRun_s,
                                  kSearchSeconds),
                      "--seconds"});
  }
  SEMVIEW_TRY(const Target target, open_target(options));
  SEMVIEW_TRY(const auto work, client::LoadWork::prepare(target.connection, target.map_id, kind));
  SEMVIEW_TRY(const auto views, client::RemoteViewSource::open(target.connection, target.map_id));
  Findings findings;
  findings.map_id = target.map_id;
  findings.engine = views->map().engine;
  findings.threads = target.threads;
  findings.cores = std::max(std::thread::hardware_concurrency(), 1U);
  // Also has the server cast every view that the robots will need.
  SEMVIEW_TRY(findings.kernel, client::kernel_time(work, *views));

  const auto run = [&](std::size_t robots) -> Result<LoadReport> {
    options.load.robots = robots;
    if (!options.cold) return load(options, target, work);
    SEMVIEW_TRY(const Target fresh, open_target(options));
    return load(options, fresh, work);
  };
  if (!options.search) {
    SEMVIEW_TRY(LoadReport report, run(options.load.robots));
    findings.steps.push_back({options.load.robots, report});
    return findings;
  }
  const auto first = static_cast<std::size_t>(findings.ceiling(options) / 2.0);
  const double run_s =
      options.load.seconds + std::chrono::duration<double>(options.load.timeout).count();
  fmt::print(stderr,
             "searching for at most {:.0f} s: up to {} runs of at most {:g} s\n",
             kSearchSeconds,
             client::kMaxSearchSteps,
             run_s);
  const TimePoint end =
      steady_clock().now() +
      std::chrono::duration_cast<Duration>(std::chrono::duration<double>(kSearchSeconds - run_s));
  SEMVIEW_TRY(auto found, client::find_most_robots(first, client::kMaxRobots, run, [end] {
                return steady_clock().now() <= end;
              }));
  findings.settled = found.settled;
  findings.steps = std::move(found.steps);
  findings.most_robots = found.robots;
  return findings;
}

void print_text(const Options& options, const Findings& findings) {
  fmt::print("map {}, engine {}, {}, {} cores\n",
             findings.map_id,
             findings.engine,
             findings.threads == 0 ? "threads as the server has them"
                                   : fmt::format("{} server threads", findings.threads),
             findings.cores);
  fmt::print("{} load, {} cache, {:g} Hz a robot; times in ms from the intended start\n",
             options.kind,
             options.cold ? "cold" : "warm",
             options.load.rate_hz);
  fmt::print("{:>6} {:>7} {:>9} {:>8} {:>8} {:>7} {:>7} {:>8} {:>8} {:>8} {:>8} {:>9}\n",
             "robots",
             "cycles",
             "answered",
             "in time",
             "refused",
             "failed",
             "lost",
             "p50",
             "p95",
             "p99",
             "max",
             "goodput/s");
  for (const auto& [robots, report] : findings.steps) {
    fmt::print(
        "{:>6} {:>7} {:>9} {:>8} {:>8} {:>7} {:>7} {:>8.1f} {:>8.1f} {:>8.1f} {:>8.1f} "
        "{:>9.1f}\n",
        robots,
        report.cycles,
        report.answered,
        report.in_time,
        report.refused,
        report.failed,
        report.timed_out,
        report.p50_ms,
        report.p95_ms,
        report.p99_ms,
        report.max_ms,
        report.goodput_hz());
  }
  const client::KernelTime& kernel = findings.kernel;
  const double ceiling = findings.ceiling(options);
  fmt::print(
      "ceiling: {} cores / ({:g} Hz x ({:.2f} ms to prepare + {:.2f} ms to score)) = {:.0f} "
      "robots\n",
      findings.cores,
      options.load.rate_hz,
      kernel.prepare_ms,
      kernel.score_ms,
      ceiling);
  if (findings.most_robots) {
    fmt::print("held: {}{} robots with 99 of 100 answers within {} ms, {:.0f} % of the ceiling\n",
               findings.settled ? "" : "at least ",
               *findings.most_robots,
               options.load.in_time.count(),
               100.0 * static_cast<double>(*findings.most_robots) / ceiling);
  }
}

void print_json(const Options& options, const Findings& findings) {
  ordered_json json{
      {"map", findings.map_id},
      {"engine", findings.engine},
      {"threads", findings.threads == 0 ? ordered_json(nullptr) : ordered_json(findings.threads)},
      {"load", options.kind},
      {"cold", options.cold},
      {"rate_hz", options.load.rate_hz},
      {"seconds", options.load.seconds},
      {"in_time_ms", options.load.in_time.count()},
      {"cores", findings.cores},
      {"prepare_ms", findings.kernel.prepare_ms},
      {"score_ms", findings.kernel.score_ms},
      {"ceiling_robots", findings.ceiling(options)},
      {"runs", ordered_json::array()}};
  for (const auto& [robots, report] : findings.steps) {
    json["runs"].push_back({{"robots", robots},
                            {"cycles", report.cycles},
                            {"answered", report.answered},
                            {"in_time", report.in_time},
                            {"refused", report.refused},
                            {"failed", report.failed},
                            {"timed_out", report.timed_out},
                            {"p50_ms", report.p50_ms},
                            {"p95_ms", report.p95_ms},
                            {"p99_ms", report.p99_ms},
                            {"max_ms", report.max_ms},
                            {"goodput_hz", report.goodput_hz()},
                            {"worst_start_ms", report.worst_start_ms}});
  }
  if (findings.most_robots) {
    json["most_robots"] = *findings.most_robots;
    json["settled"] = findings.settled;
  }
  fmt::print("{}\n", json.dump(2));
}

Status run(const CLI::App& verb, const Options& options) {
  if (!options.server.empty()) SEMVIEW_TRY_STATUS(check_no_site_options(verb));
  SEMVIEW_TRY(const Findings findings, measure(options));
  options.json ? print_json(options, findings) : print_text(options, findings);
  return {};
}

}  // namespace

void add_bench_load_verb(CLI::App& bench, int& exit_code) {
  CLI::App* verb = bench.add_subcommand(
      "load",
      "Simulated robots ask a server on this machine, each at a fixed rate whatever the answers "
      "do: "
      "a fresh observation, then scores. Times run from the moment at which a cycle was meant to "
      "begin. The ceiling beside them is what the cores could do if nothing but the kernels ran; "
      "robots and server share them here.");
  const auto options = std::make_shared<Options>();
  add_site_options(*verb, options->site);
  auto* server = verb->add_option("--server",
                                  options->server,
                                  "A server on this machine, for example tcp://127.0.0.1:5560; MAP "
                                  "is then one of its ids. Default: one in this process");
  verb->get_option("--threads")->excludes(server);
  auto* robots =
      verb->add_option("--robots", options->load.robots, "How many robots")->capture_default_str();
  verb->add_option("--rate", options->load.rate_hz, "Cycles a second of each, Hz")
      ->capture_default_str();
  verb->add_option("--seconds", options->load.seconds, "How long cycles begin, s")
      ->capture_default_str();
  verb->add_option("--load",
                   options->kind,
                   "global: compass in up to 2000 cells of the floor; tracking: 300 poses around "
                   "the robot, headings as given")
      ->check(CLI::IsMember({"global", "tracking"}))
      ->capture_default_str();
  verb->add_flag("--cold", options->cold, "Begin each run with an empty cache")
      ->excludes(server)
      ->excludes("--cache");
  verb->add_flag("--search",
                 options->search,
                 "Find the most robots of whom 99 in 100 have their answers within 250 ms; 16 runs "
                 "and 180 s at most")
      ->excludes(robots);
  verb->add_flag("--json", options->json, "Print JSON");
  verb->footer("Example: semview bench load maps/duplex_level1 --load tracking --search");
  verb->callback([verb, options, &exit_code] { exit_code = report(run(*verb, *options)); });
}

}  // namespace semview::cli
