// SPDX-License-Identifier: Apache-2.0
/// Where requests come in and replies go out.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "admission.hpp"
#include "dispatcher.hpp"
#include "outbox.hpp"
#include "semview/core/clock.hpp"
#include "semview/core/latency_histogram.hpp"
#include "semview/core/result.hpp"
#include "semview/v1/envelope.pb.h"
#include "server.hpp"
#include "sockets.hpp"

namespace semview::server {

/// Takes requests from the sockets, lets them in or refuses them, and sends replies and events.
///
/// One thread is in `run`. The workers of the dispatcher leave their replies here, so the
/// reception must outlive it.
/// @threads All members but `run` from any thread.
class Reception {
 public:
  Reception(const ServerConfig& config, std::unique_ptr<Sockets> sockets, const Clock& clock);

  const Sockets& sockets() const { return *sockets_; }

  /// Serves until `close` was called and all requests inside are answered, or its time is up.
  void run(Dispatcher& dispatcher);
  /// From now on requests are refused, and `run` comes to its end, at `until` at the latest.
  void close(TimePoint until);
  /// Sends an event when `run` next turns to it.
  void publish(std::string topic, std::string body);

  /// True if nothing is inside; after the end of `run`.
  bool all_answered() const { return admission_.in_flight() == 0 && outbox_.empty(); }
  /// Fills in what is counted here.
  void count_into(ServerCounters* counters) const;

 private:
  /// A finished request on its way to the thread in `run`.
  struct Finished {
    Outgoing reply;
    std::size_t body_bytes = 0;  ///< of the request
  };
  using Latencies = std::map<std::string, LatencyHistogram, std::less<>>;
  struct Event {
    std::string topic;
    std::string body;
  };

  bool receive_some(Dispatcher& dispatcher);
  void take(Incoming incoming, Dispatcher& dispatcher);
  Status read_header(const Incoming& incoming, v1::RequestHeader* header);
  Status admit(const Incoming& incoming,
               const v1::RequestHeader& header,
               std::chrono::milliseconds budget,
               const Dispatcher& dispatcher) const;
  std::chrono::milliseconds budget_of(const v1::RequestHeader& header) const;
  void refuse(const Incoming& incoming, std::uint64_t request_id, Error error);
  void send_finished();

  Outgoing reply_of(const std::string& client,
                    bool delimiter,
                    std::uint64_t request_id,
                    Result<std::string> result);
  void finish(Finished finished);

  const ServerConfig config_;
  const Clock& clock_;
  const std::unique_ptr<Sockets> sockets_;

  // Of the thread in `run`, but for their counts.
  Admission admission_;
  Outbox outbox_;

  std::mutex left_mutex_;  ///< guards finished_, events_
  std::deque<Finished> finished_;
  std::vector<Event> events_;

  TimePoint close_at_;  ///< set before closing_
  std::atomic<bool> closing_{false};
  std::atomic<std::uint64_t> requests_{0};
  std::atomic<std::uint64_t> errors_{0};
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<std::uint64_t> expired_{0};
  std::atomic<std::uint64_t> malformed_{0};
  Latencies latencies_;  ///< one a method; its keys never change
};

}  // namespace semview::server
