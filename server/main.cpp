// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "options.hpp"
#include "semview/core/byte_size.hpp"
#include "semview/core/log.hpp"
#include "semview/core/version.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "sockets.hpp"

namespace semview::server {
namespace {

constexpr const char* kFooter = R"(Example:
  semview-server --map maps/duplex_level1 --map attic=maps/duplex_level2 --cache /var/cache/semview

Prints one line "listening on tcp://ADDRESS:PORT" on standard output when requests can come in;
the log goes to standard error. SIGTERM or SIGINT answers what is inside, then exits with 0.
Protocol: docs/protocol.md.)";

/// Options as given; those not given leave the configuration file's value.
struct CommandLine {
  std::vector<std::string> maps;
  std::string config;
  std::optional<std::string> bind;
  std::optional<std::uint16_t> events_port;
  std::optional<std::string> cache;
  std::optional<std::string> cache_limit;
  std::optional<std::string> memory;
  std::optional<std::size_t> threads;
  std::optional<double> eye_height_m;
  std::optional<std::string> engine;
  bool ranges = false;
  bool nearest_colour = false;
};

void add_options(CLI::App& app, CommandLine& line) {
  app.add_option(
      "--map",
      line.maps,
      "[ID=]FOLDER or [ID=]FILE.glb; several may be given. ID (a-z, 0-9, _ and -) is what "
      "clients call the map; default: its own");
  app.add_option("--config", line.config, "server.yaml: the same options and the limits");
  app.add_option(
      "--bind",
      line.bind,
      "tcp://ADDRESS:PORT for requests (default tcp://127.0.0.1:5560; * as port takes any "
      "free one)");
  app.add_option("--events-port",
                 line.events_port,
                 "TCP port of the progress events, on --bind's address; open it in a firewall, too "
                 "(default 0: any free one; Hello tells clients which)");
  app.add_option("--cache", line.cache, "folder that keeps views between runs");
  app.add_option(
      "--cache-limit",
      line.cache_limit,
      "store no more than this many bytes (500M, 20G); default 0: as far as the disk goes");
  app.add_option("--memory", line.memory, "bytes of views kept in memory (default 512M)");
  constexpr int kMostThreads = 1024;  // what service::validate allows
  app.add_option("--threads", line.threads, "workers (default: one a core)")
      ->check(CLI::Range(0, kMostThreads));
  app.add_option("--eye-height", line.eye_height_m, "camera above the ground in m (default 1.2)");
  app.add_option("--engine",
                 line.engine,
                 "auto, columns (plans only) or embree (default: SEMVIEW_ENGINE in the "
                 "environment, else auto)");
  app.add_flag("--ranges", line.ranges, "views of the grid carry ranges (in a cache of their own)");
  app.add_flag("--nearest-colour", line.nearest_colour, "accept plans with smoothed edges");
}

Result<Options> options_of(const CommandLine& line) {
  Options options;
  const char* const engine = std::getenv("SEMVIEW_ENGINE");
  if (engine != nullptr && *engine != '\0') options.site.engine = engine;
  if (!line.config.empty()) SEMVIEW_TRY_STATUS(read_config(line.config, &options));
  for (const std::string& text : line.maps) {
    SEMVIEW_TRY(MapOption map, parse_map_option(text));
    options.maps.push_back(std::move(map));
  }
  if (line.bind) options.server.bind = *line.bind;
  if (line.events_port) options.server.events_port = *line.events_port;
  if (line.cache) options.site.cache_directory = *line.cache;
  if (line.cache_limit) {
    SEMVIEW_TRY(options.site.cache_limit_bytes,
                parse_byte_size("--cache-limit", *line.cache_limit));
  }
  if (line.memory) {
    SEMVIEW_TRY(options.site.memory_bytes, parse_byte_size("--memory", *line.memory));
  }
  if (line.threads) options.site.threads = *line.threads;
  if (line.eye_height_m) options.site.profile.eye_height_m = *line.eye_height_m;
  if (line.engine) options.site.engine = *line.engine;
  options.site.profile.ranges = options.site.profile.ranges || line.ranges;
  options.site.nearest_colour = options.site.nearest_colour || line.nearest_colour;
  options.server.workers = options.site.threads;
  if (options.maps.empty()) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      "no map given",
                      "--map",
                      "for example: semview-server --map maps/duplex_level1"});
  }
  SEMVIEW_TRY_STATUS(service::validate(options.site));
  return options;
}

Result<service::MapRegistry> open_maps(const Options& options) {
  SEMVIEW_TRY(const service::SharedTiers tiers, service::SharedTiers::open(options.site));
  service::MapRegistry maps;
  for (const MapOption& option : options.maps) {
    SEMVIEW_TRY(std::shared_ptr<service::Site> site,
                service::Site::open(option.path, option.id, options.site, tiers));
    log_info(fmt::format("map {} ({}): {} classes, {} free cells, engine {} ({}), fingerprint {}",
                         site->id(),
                         site->map().name,
                         site->map().classes.size(),
                         site->cells().free_count(),
                         site->engine().name,
                         site->engine().reason,
                         to_hex(site->map().fingerprint)));
    SEMVIEW_TRY_STATUS(maps.add(std::move(site)));
  }
  return maps;
}

std::uint64_t new_epoch() {
  std::random_device device;
  return (std::uint64_t{device()} << 32U | device()) | 1U;
}

/// Serves until a signal comes; blocked in all threads, it is taken here.
Status serve(const CommandLine& line) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);

  SEMVIEW_TRY(Options options, options_of(line));
  options.server.epoch = new_epoch();
  // The maps may take a while: an address that is taken is told before.
  SEMVIEW_TRY(std::unique_ptr<Sockets> sockets, Server::bind(options.server));
  SEMVIEW_TRY(service::MapRegistry maps, open_maps(options));
  const std::unique_ptr<Server> server =
      Server::serve(options.server, std::move(sockets), std::move(maps));
  if (!is_loopback(server->endpoint())) {
    log_warning(
        fmt::format("{} can be reached from other machines, and there is no authentication "
                    "yet: use it in trusted networks only",
                    server->endpoint()));
  }
  if (!server->events_endpoint().empty()) {
    log_info(fmt::format("events on {}", server->events_endpoint()));
  }
  fmt::print("listening on {}\n", server->endpoint());
  std::fflush(stdout);

  int signal = 0;
  sigwait(&signals, &signal);
  log_info(fmt::format("{}: answering what is inside, then leaving",
                       signal == SIGTERM ? "SIGTERM" : "SIGINT"));
  const bool answered = server->drain(std::chrono::seconds(options.drain_s));
  if (!answered) log_warning("some requests were not answered in time");
  return {};
}

}  // namespace
}  // namespace semview::server

int main(int argc, char** argv) {
  constexpr int kFailed = 1;
  constexpr int kUsage = 2;
  // A limit on file sizes ends storing, as a full disk does, and not the program.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    CLI::App app{"semview-server: views and scores of semantic maps over ZeroMQ", "semview-server"};
    app.set_version_flag("--version", semview::kVersion);
    app.footer(semview::server::kFooter);
    semview::server::CommandLine line;
    semview::server::add_options(app, line);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return app.exit(error) == 0 ? 0 : kUsage;
    }
    const semview::Status status = semview::server::serve(line);
    if (status) return 0;
    const semview::Error& error = status.error();
    fmt::print(stderr, "semview-server: {}\n", error.message);
    if (!error.hint.empty()) fmt::print(stderr, "  {}\n", error.hint);
    return error.field.starts_with("--") ? kUsage : kFailed;
  } catch (const std::exception& error) {
    fmt::print(stderr, "semview-server: internal error: {}\n", error.what());
    return kFailed;
  }
}
