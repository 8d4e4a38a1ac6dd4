// SPDX-License-Identifier: Apache-2.0
/// Replies that wait for clients which read slowly.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <unordered_map>

namespace semview::server {

struct Outgoing {
  std::string client;
  bool delimiter = false;
  std::string header;
  std::string body;

  std::size_t bytes() const { return client.size() + header.size() + body.size(); }
};

enum class Sent {
  kSent,
  kFull,  ///< the client does not read; later it may
  kGone,  ///< there is no such client any more
};

/// Hands replies to the socket, in order for each client, and keeps those that it cannot take yet,
/// within limits: a client that asks and never reads must not fill the memory.
/// @threads For one thread; `undelivered` from any.
class Outbox {
 public:
  using Send = std::function<Sent(const Outgoing&)>;

  /// `max_bytes` of all clients together; beyond either limit replies are dropped and counted.
  Outbox(Send send, std::uint64_t max_bytes, std::size_t max_replies_per_client);

  void deliver(Outgoing reply);
  /// Tries again what waits.
  void flush();

  bool empty() const { return waiting_.empty(); }
  /// Replies that wait for one client.
  std::size_t waiting(const std::string& client) const;
  std::uint64_t undelivered() const { return undelivered_; }

 private:
  using Replies = std::deque<Outgoing>;

  /// Sends from the front; true when nothing is left.
  bool send_some(Replies& replies);
  void drop_front(Replies& replies);

  const Send send_;
  const std::uint64_t max_bytes_;
  const std::size_t max_replies_per_client_;
  std::unordered_map<std::string, Replies> waiting_;  ///< no empty ones
  std::uint64_t bytes_ = 0;
  std::atomic<std::uint64_t> undelivered_{0};
};

}  // namespace semview::server
