// SPDX-License-Identifier: Apache-2.0
#include "reception.hpp"

#include <algorithm>
#include <exception>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "methods.hpp"
#include "semview/core/log.hpp"
#include "semview/protocol/descriptions.hpp"
#include "semview/protocol/envelope.hpp"

namespace semview::server {
namespace {

/// How long the thread sleeps when nothing happens.
constexpr std::chrono::milliseconds kIdle{1000};
/// How soon it looks again while the end or an unread reply is waited for.
constexpr std::chrono::milliseconds kSoon{10};
/// Replies that wait for one client: beyond its requests in flight these are refusals, and small.
constexpr std::size_t kMaxUnreadReplies = 1000;

}  // namespace

Reception::Reception(const ServerConfig& config,
                     std::unique_ptr<Sockets> sockets,
                     const Clock& clock)
    : config_(config),
      clock_(clock),
      sockets_(std::move(sockets)),
      admission_(config.limits, config.max_queued_bytes),
      outbox_([this](const Outgoing& reply) { return sockets_->send(reply); },
              config.max_queued_bytes,
              kMaxUnreadReplies) {
  for (const std::string_view name : method_names()) latencies_[std::string(name)];
}

void Reception::run(Dispatcher& dispatcher) {
  for (;;) {
    bool received = false;
    try {
      sockets_->wait(closing_ || !outbox_.empty() ? kSoon : kIdle);
      received = receive_some(dispatcher);
      send_finished();
    } catch (const std::exception& error) {
      log_error(fmt::format("I/O: {}", error.what()));
    }
    // Requests are let in by this thread alone: none can slip in after the last look. Whoever
    // waits for the end waits in real time, whatever clock tells the deadlines.
    if (closing_ && ((all_answered() && !received) || steady_clock().now() >= close_at_)) return;
  }
}

void Reception::close(TimePoint until) {
  close_at_ = until;
  closing_ = true;
  sockets_->ring();
}

void Reception::publish(std::string topic, std::string body) {
  {
    const std::lock_guard lock(left_mutex_);
    events_.push_back({std::move(topic), std::move(body)});
  }
  sockets_->ring();
}

void Reception::count_into(ServerCounters* counters) const {
  counters->requests = requests_;
  counters->errors = errors_;
  counters->refused = refused_;
  counters->expired = expired_;
  counters->malformed = malformed_;
  counters->undelivered = outbox_.undelivered();
  counters->in_flight = admission_.in_flight();
  for (const auto& [method, histogram] : latencies_) {
    const LatencySummary summary = histogram.summary();
    if (summary.count > 0) counters->latency_by_method[method] = summary;
  }
}

/// A bounded number, so that a flood of requests does not hold up the replies.
bool Reception::receive_some(Dispatcher& dispatcher) {
  constexpr int kMost = 100;
  for (int i = 0; i < kMost; ++i) {
    std::optional<Incoming> incoming = sockets_->receive();
    if (!incoming) return i > 0;
    take(*std::move(incoming), dispatcher);
  }
  sockets_->ring();
  return true;
}

void Reception::take(Incoming incoming, Dispatcher& dispatcher) {
  v1::RequestHeader header;
  if (Status status = read_header(incoming, &header); !status) {
    return refuse(incoming, header.request_id(), std::move(status).error());
  }
  const std::chrono::milliseconds budget = budget_of(header);
  if (Status status = admit(incoming, header, budget, dispatcher); !status) {
    return refuse(incoming, header.request_id(), std::move(status).error());
  }
  const std::size_t bytes = incoming.body.size();
  const TimePoint received = clock_.now();
  // Admitted: there is such a method.
  LatencyHistogram& latencies = latencies_.find(header.method())->second;
  admission_.enter(incoming.client, bytes);
  Request request{incoming.client,
                  header.client_name(),
                  header.method(),
                  std::move(incoming.body),
                  received + budget};
  dispatcher.submit(std::move(request),
                    planning_cells(header.method()),
                    [this,
                     client = std::move(incoming.client),
                     delimiter = incoming.delimiter,
                     id = header.request_id(),
                     bytes,
                     received,
                     &latencies](Result<std::string> result) {
                      latencies.add(clock_.now() - received);
                      finish({reply_of(client, delimiter, id, std::move(result)), bytes});
                    });
}

/// @errors kDataLoss: frames or header cannot be read; those of `protocol::validate`.
Status Reception::read_header(const Incoming& incoming, v1::RequestHeader* header) {
  Result<v1::RequestHeader> parsed = protocol::parse<v1::RequestHeader>(incoming.header, "header");
  if (!incoming.well_formed) {
    ++malformed_;
    // The header, if there is one, tells the sender which request this was.
    if (parsed) *header = *std::move(parsed);
    return fail(Error{ErrorCode::kDataLoss,
                      fmt::format("frames: {}; expected a header and a body", incoming.frames),
                      "frames"});
  }
  if (!parsed) {
    ++malformed_;
    return fail(std::move(parsed).error());
  }
  *header = *std::move(parsed);
  ++requests_;
  return protocol::validate(*header);
}

std::chrono::milliseconds Reception::budget_of(const v1::RequestHeader& header) const {
  return std::chrono::milliseconds(header.deadline_ms() == 0
                                       ? config_.default_deadline_ms
                                       : std::min(header.deadline_ms(), config_.max_deadline_ms));
}

/// @errors kUnavailable: the server is shutting down; those of `Admission::check` and `check_wait`.
Status Reception::admit(const Incoming& incoming,
                        const v1::RequestHeader& header,
                        std::chrono::milliseconds budget,
                        const Dispatcher& dispatcher) const {
  if (closing_) {
    return fail(Error{ErrorCode::kUnavailable,
                      "the server is shutting down",
                      "",
                      "send it again when the server is back",
                      kRetryAfter_ms});
  }
  SEMVIEW_TRY_STATUS(admission_.check(incoming.client,
                                      header.method(),
                                      incoming.body.size(),
                                      outbox_.waiting(incoming.client),
                                      dispatcher.queued_cells()));
  return check_wait(
      header.method(), dispatcher.expected_wait(incoming.client, header.method()), budget);
}

void Reception::refuse(const Incoming& incoming, std::uint64_t request_id, Error error) {
  outbox_.deliver(
      reply_of(incoming.client, incoming.delimiter, request_id, fail(std::move(error))));
}

void Reception::send_finished() {
  std::deque<Finished> finished;
  std::vector<Event> events;
  {
    const std::lock_guard lock(left_mutex_);
    finished.swap(finished_);
    events.swap(events_);
  }
  outbox_.flush();
  for (Finished& one : finished) {
    admission_.leave(one.reply.client, one.body_bytes);
    outbox_.deliver(std::move(one.reply));
  }
  for (const Event& event : events) sockets_->publish(event.topic, event.body);
}

/// From any thread.
Outgoing Reception::reply_of(const std::string& client,
                             bool delimiter,
                             std::uint64_t request_id,
                             Result<std::string> result) {
  v1::ReplyHeader header;
  header.set_request_id(request_id);
  header.set_protocol_version(protocol::kProtocolVersion);
  header.set_server_epoch(config_.epoch);
  if (result) return {client, delimiter, header.SerializeAsString(), *std::move(result)};
  ++errors_;
  if (result.error().code == ErrorCode::kResourceExhausted) ++refused_;
  if (result.error().code == ErrorCode::kDeadlineExceeded) ++expired_;
  *header.mutable_error() = protocol::to_wire(result.error());
  return {client, delimiter, header.SerializeAsString(), {}};
}

/// From any thread.
void Reception::finish(Finished finished) {
  {
    const std::lock_guard lock(left_mutex_);
    finished_.push_back(std::move(finished));
  }
  sockets_->ring();
}

}  // namespace semview::server
