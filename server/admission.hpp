// SPDX-License-Identifier: Apache-2.0
/// Which requests are let in: everything from outside has a limit.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include "semview/core/clock.hpp"
#include "semview/core/result.hpp"
#include "semview/service/limits.hpp"

namespace semview::server {

/// Will a request be done within its budget, as far as can be told?
///
/// Half the budget may pass before it is begun: the work takes time too, and the expectation errs.
/// Of that of a SetObservation a twelfth: its Score is still to come, and others come meanwhile who
/// share the workers with it. A robot that is let in and is then too late has taken the time of one
/// that would not have been: with a quarter, an overloaded server answers almost nobody in time,
/// with a twelfth as many as it can (overload_simulation_test.cpp).
/// @param expected_wait  `Dispatcher::expected_wait`.
/// @errors kResourceExhausted: no.
Status check_wait(std::string_view method, Duration expected_wait, Duration budget);

/// Counts requests that are not answered yet.
/// @threads For one thread; `in_flight` from any.
class Admission {
 public:
  Admission(const service::Limits& limits, std::uint64_t max_queued_bytes);

  /// Is there such a method, and room for one more request of `body_bytes`?
  /// @param unread  Replies that the client has not taken yet.
  /// @param queued_cells  Work that waits, of all clients.
  /// @errors kUnimplemented: no such method; kResourceExhausted: above a limit.
  Status check(const std::string& client,
               const std::string& method,
               std::size_t body_bytes,
               std::size_t unread,
               std::uint64_t queued_cells) const;

  void enter(const std::string& client, std::size_t body_bytes);
  void leave(const std::string& client, std::size_t body_bytes);

  std::uint64_t in_flight() const { return in_flight_; }

 private:
  const service::Limits limits_;
  const std::uint64_t max_queued_bytes_;
  std::unordered_map<std::string, std::size_t> in_flight_of_;
  std::uint64_t queued_bytes_ = 0;
  std::atomic<std::uint64_t> in_flight_{0};
};

}  // namespace semview::server
