// SPDX-License-Identifier: Apache-2.0
/// `semview bench load`: how many robots a server holds.
#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench_load_findings.hpp"
#include "bench_verbs.hpp"
#include "client/lib/remote_view_source.hpp"
#include "client/load/dealer_wire.hpp"
#include "client/load/kernel_time.hpp"
#include "client/load/load_work.hpp"
#include "client/load/most_robots.hpp"
#include "client/load/open_loop.hpp"
#include "server/server.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

using client::LoadKind;
using client::LoadReport;
using Options = LoadOptions;
using Findings = LoadFindings;

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

Result<LoadReport> load(const Options& options,
                        const Target& target,
                        const client::LoadWork& work) {
  SEMVIEW_TRY(const auto wire,
              client::DealerWire::open(target.connection.endpoint, options.load.robots));
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
  Findings findings;
  if (options.search) {
    SEMVIEW_TRY(findings.fewest_robots, client::fewest_robots(options.load));
  }
  SEMVIEW_TRY(const Target target, open_target(options));
  SEMVIEW_TRY(const auto work, client::LoadWork::prepare(target.connection, target.map_id, kind));
  SEMVIEW_TRY(const auto views, client::RemoteViewSource::open(target.connection, target.map_id));
  findings.map_id = target.map_id;
  findings.engine = views->map().engine;
  findings.engine_reason = views->map().engine_reason;
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
  const auto first = static_cast<std::size_t>(findings.ceiling(options.load) / 2.0);
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
  SEMVIEW_TRY(
      auto found,
      client::find_most_robots(findings.fewest_robots, first, client::kMaxRobots, run, [end] {
        return steady_clock().now() <= end;
      }));
  findings.settled = found.settled;
  findings.steps = std::move(found.steps);
  findings.most_robots = found.robots;
  return findings;
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
                 "and 180 s at most, each of 100 cycles or more")
      ->excludes(robots);
  verb->add_flag("--json", options->json, "Print JSON");
  verb->footer("Example: semview bench load maps/duplex_level1 --load tracking --search");
  verb->callback([verb, options, &exit_code] { exit_code = report(run(*verb, *options)); });
}

}  // namespace semview::cli
