// SPDX-License-Identifier: Apache-2.0
#include "admission.hpp"

#include <chrono>
#include <utility>

#include <fmt/format.h>

#include "methods.hpp"

namespace semview::server {
namespace {

tl::unexpected<Error> busy(std::string message) {
  return fail(Error{ErrorCode::kResourceExhausted,
                    std::move(message),
                    "",
                    "the server is busy: send it again later",
                    kRetryAfter_ms});
}

double ms_of(Duration time) { return std::chrono::duration<double, std::milli>(time).count(); }

}  // namespace

Status check_wait(std::string_view method, Duration expected_wait, Duration budget) {
  const int share = method == "SetObservation" ? 12 : 2;
  if (share * expected_wait <= budget) return {};
  return busy(
      fmt::format("{}: work of about {:.0f} ms comes first, too much for a budget of {:.0f} ms",
                  method,
                  ms_of(expected_wait),
                  ms_of(budget)));
}

Admission::Admission(const service::Limits& limits, std::uint64_t max_queued_bytes)
    : limits_(limits), max_queued_bytes_(max_queued_bytes) {}

Status Admission::check(const std::string& client,
                        const std::string& method,
                        std::size_t body_bytes,
                        std::size_t unread,
                        std::uint64_t queued_cells) const {
  if (planning_cells(method) == 0) {
    return fail(Error{ErrorCode::kUnimplemented,
                      fmt::format("method: '{}' is not known; expected one of {}",
                                  method,
                                  fmt::join(method_names(), ", ")),
                      "method"});
  }
  if (body_bytes > limits_.max_message_bytes) {
    return fail(
        Error{ErrorCode::kResourceExhausted,
              fmt::format("body: {} bytes; at most {}", body_bytes, limits_.max_message_bytes),
              "body",
              "split the request"});
  }
  const auto found = in_flight_of_.find(client);
  const std::size_t own = found == in_flight_of_.end() ? 0 : found->second;
  if (own == 0 && in_flight_of_.size() >= limits_.max_clients) {
    return busy(fmt::format("{} clients wait for answers already", in_flight_of_.size()));
  }
  if (own + unread >= limits_.max_in_flight_per_client) {
    return busy(fmt::format(
        "{} requests of this client are unanswered, {} of its replies unread", own, unread));
  }
  if (queued_bytes_ + body_bytes > max_queued_bytes_) {
    return busy(fmt::format("requests of {} bytes wait already", queued_bytes_));
  }
  if (queued_cells >= limits_.max_queued_cells) {
    return busy(fmt::format("{} cells of work wait already", queued_cells));
  }
  return {};
}

void Admission::enter(const std::string& client, std::size_t body_bytes) {
  ++in_flight_of_[client];
  queued_bytes_ += body_bytes;
  ++in_flight_;
}

void Admission::leave(const std::string& client, std::size_t body_bytes) {
  const auto own = in_flight_of_.find(client);
  if (--own->second == 0) in_flight_of_.erase(own);
  queued_bytes_ -= body_bytes;
  --in_flight_;
}

}  // namespace semview::server
