// SPDX-License-Identifier: Apache-2.0
/// One client's line to a semview-server. Frames and methods: docs/protocol.md.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "semview/core/result.hpp"

namespace semview::client {

struct ConnectionConfig {
  std::string endpoint = "tcp://127.0.0.1:5560";
  /// Longest wait for one call, its repetitions included; also sent as the server's time budget.
  std::chrono::milliseconds timeout{5000};
  /// Of `timeout`, the longest wait for a line to the server, at first and after each break: a
  /// server at work may be waited for long, but nobody waits long for one that is not there.
  std::chrono::milliseconds contact{5000};
  /// How often a call that is safe to repeat is sent while `timeout` lasts; at least 1.
  int attempts = 3;
  std::string client_name = "semview";  ///< shown in the server's log; at most 64 bytes
};

/// @errors kInvalidArgument: a field is out of range, or the endpoint is not `tcp://host:port`.
Status validate(const ConnectionConfig& config);

/// May a call be sent again when no answer came?
enum class Repeat {
  kSafe,   ///< reads, or writes that may happen twice
  kNever,  ///< would do something twice
};

/// Sends requests one after the other and waits for their replies.
///
/// Survives a restart of the server: the next call finds it again. After no answer the socket is
/// thrown away, so that a late reply cannot be taken for the next one.
/// @threads For one thread at a time; several connections may live in one program.
class Connection {
 public:
  /// Makes no contact yet: a server may come up later.
  static Result<Connection> open(const ConnectionConfig& config);
  ~Connection();
  Connection(Connection&&) noexcept;
  Connection& operator=(Connection&&) noexcept;

  const ConnectionConfig& config() const;

  /// One request: the serialised body of `method`'s request message → that of its reply message.
  /// @errors the server's own; kDeadlineExceeded: the server answered nothing while `timeout`
  /// lasted although it was reached before; kUnavailable: it was never reached, or is gone, for
  /// `contact`;
  /// kDataLoss: a reply that cannot be read.
  Result<std::string> call(std::string_view method, std::string_view body, Repeat repeat);

  /// Whether the server answers at all, waiting no longer than `patience`; for callers that must go
  /// on while it is away. The question stays under way from one call to the next, so an answer that
  /// takes longer than `patience` counts when it is asked again.
  bool answers(std::chrono::milliseconds patience);

  /// Which start of the server answered last; 0 before the first reply. What a server kept for a
  /// client (observations, jobs) is gone when this changes.
  std::uint64_t server_epoch() const;

  /// Bytes of the bodies of all replies so far.
  std::uint64_t received_bytes() const;

 private:
  class Line;
  explicit Connection(std::unique_ptr<Line> line);
  std::unique_ptr<Line> line_;
};

}  // namespace semview::client
