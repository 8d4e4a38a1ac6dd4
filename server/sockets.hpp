// SPDX-License-Identifier: Apache-2.0
/// The server's two sockets and the bell that wakes their thread. ZeroMQ stays behind this header.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "outbox.hpp"
#include "semview/core/result.hpp"

namespace semview::server {

/// A message as it came in: `[delimiter?] [header] [body]`.
struct Incoming {
  std::string client;       ///< the connection's identity, given by the ROUTER socket
  bool delimiter = false;   ///< an empty frame came first (REQ clients): mirrored in the reply
  bool well_formed = true;  ///< exactly a header and a body
  std::size_t frames = 0;   ///< without identity and delimiter
  std::string header;
  std::string body;
};

struct SocketConfig {
  std::string bind = "tcp://127.0.0.1:5560";  ///< `*` as port: any free one
  bool events = true;                         ///< also a PUB socket, on the same address
  std::uint16_t events_port = 0;              ///< 0: any free one
  std::size_t max_message_bytes = std::size_t{64} << 20U;
};

/// ROUTER for requests, PUB for events.
/// @threads All members from the one thread that owns it, but `ring` from any.
class Sockets {
 public:
  /// @errors kInvalidArgument: not `tcp://address:port`; kUnavailable: an address is in use or
  /// not ours.
  static Result<std::unique_ptr<Sockets>> bind(const SocketConfig& config);
  ~Sockets();

  /// With the real port.
  const std::string& endpoint() const;
  const std::string& events_endpoint() const;  ///< empty: none
  std::uint16_t events_port() const;

  /// Waits until a request can be received, the bell was rung, or time is up.
  void wait(std::chrono::milliseconds time);
  /// The next request, if one is there.
  std::optional<Incoming> receive();
  Sent send(const Outgoing& reply);
  void publish(std::string_view topic, std::string_view event);

  /// Ends a `wait`, this one or the next.
  void ring();

 private:
  struct Parts;
  explicit Sockets(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace semview::server
