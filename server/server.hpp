// SPDX-License-Identifier: Apache-2.0
/// A running server: maps behind sockets. See docs/protocol.md.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "methods.hpp"
#include "semview/core/clock.hpp"
#include "semview/core/result.hpp"
#include "semview/service/limits.hpp"
#include "semview/service/map_registry.hpp"

namespace semview::server {

struct ServerConfig {
  std::string bind = "tcp://127.0.0.1:5560";  ///< `*` as port: any free one
  bool events = true;                         ///< PUB socket for progress
  std::uint16_t events_port = 0;              ///< of that socket; 0: any free one
  std::size_t workers = 0;                    ///< 0: one a core
  service::Limits limits = {};
  /// Bytes of requests that wait, all clients together; and as many of replies that are not read.
  std::uint64_t max_queued_bytes = std::uint64_t{512} << 20U;
  std::uint32_t default_deadline_ms = 30'000;  ///< of requests that name none
  std::uint32_t max_deadline_ms = 600'000;     ///< longer ones are cut to this
  /// Differs after every start, not 0: clients tell a restart by it.
  std::uint64_t epoch = 1;
};

class Sockets;

/// One thread owns the sockets, workers do the work, one more runs the long jobs.
///
/// @threads All members from several threads at once.
class Server {
 public:
  /// The addresses of a server to be: what is wrong with them is known before its maps are loaded.
  /// @errors those of `Sockets::bind`.
  static Result<std::unique_ptr<Sockets>> bind(const ServerConfig& config);
  /// Serves on bound sockets; requests that have come in already are answered. `clock` must outlive
  /// the server; it tells deadlines.
  static std::unique_ptr<Server> serve(const ServerConfig& config,
                                       std::unique_ptr<Sockets> sockets,
                                       service::MapRegistry maps,
                                       const Clock& clock = steady_clock());
  /// Both.
  static Result<std::unique_ptr<Server>> start(const ServerConfig& config,
                                               service::MapRegistry maps,
                                               const Clock& clock = steady_clock());
  /// Drains and stops.
  ~Server();

  const std::string& endpoint() const;
  const std::string& events_endpoint() const;  ///< empty: none

  /// Lets the requests inside be answered for at most `patience`, refuses new ones with
  /// kUnavailable, cancels jobs, and stops. True if everything inside was answered.
  bool drain(std::chrono::milliseconds patience);

  ServerCounters counters() const;

 private:
  class Parts;
  explicit Server(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace semview::server
