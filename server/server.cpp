// SPDX-License-Identifier: Apache-2.0
#include "server.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "admission.hpp"
#include "dispatcher.hpp"
#include "outbox.hpp"
#include "semview/core/log.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/map_wire.hpp"
#include "semview/v1/jobs.pb.h"
#include "sockets.hpp"

namespace semview::server {
namespace {

/// How long the I/O thread sleeps when nothing happens.
constexpr std::chrono::milliseconds kIdle{1000};
/// How soon it looks again while a drain or an unread reply is waited for.
constexpr std::chrono::milliseconds kSoon{10};
/// Replies that wait for one client: beyond its requests in flight these are refusals, and small.
constexpr std::size_t kMaxUnreadReplies = 1000;
constexpr std::chrono::milliseconds kDrainOfDestructor{5000};

struct Event {
  std::string topic;
  std::string body;
};

/// A finished request on its way back to the I/O thread.
struct Finished {
  Outgoing reply;
  std::size_t body_bytes = 0;  ///< of the request
};

}  // namespace

class Server::Parts {
 public:
  Parts(const ServerConfig& config,
        service::MapRegistry maps,
        std::unique_ptr<Sockets> sockets,
        const Clock& clock)
      : config_(config),
        clock_(clock),
        started_(clock.now()),
        sockets_(std::move(sockets)),
        services_(std::move(maps), config.limits, config.epoch),
        endpoint_(sockets_->endpoint()),
        events_endpoint_(sockets_->events_endpoint()),
        admission_(config.limits, config.max_queued_bytes),
        outbox_([this](const Outgoing& reply) { return sockets_->send(reply); },
                config.max_queued_bytes,
                kMaxUnreadReplies) {
    services_.default_deadline_ms = config.default_deadline_ms;
    services_.max_deadline_ms = config.max_deadline_ms;
    services_.events_port = sockets_->events_port();
    services_.counters = [this] { return counters(); };
    services_.queued_cells = [this] { return dispatcher_->queued_cells(); };
    services_.job_was_started = [this] { wake_jobs(); };
    services_.jobs.on_change([this](const service::JobStatus& status) { announce(status); });
    dispatcher_ = std::make_unique<Dispatcher>(
        config.workers == 0 ? std::thread::hardware_concurrency() : config.workers,
        [this](const Request& request) { return plan_request(services_, request); },
        clock);
    jobs_thread_ = std::thread([this] { run_jobs(); });
    io_thread_ = std::thread([this] { run_io(); });
  }

  ~Parts() {
    drain(kDrainOfDestructor);
    dispatcher_.reset();  // its workers use what is destroyed below
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  const std::string& endpoint() const { return endpoint_; }
  const std::string& events_endpoint() const { return events_endpoint_; }

  bool drain(std::chrono::milliseconds patience) {
    const std::lock_guard only_one(drain_mutex_);
    if (!io_thread_.joinable()) return answered();
    {
      const std::lock_guard lock(jobs_mutex_);
      jobs_ending_ = true;
    }
    services_.jobs.cancel_all();
    jobs_wanted_.notify_all();
    jobs_thread_.join();
    // Whoever waits for a drain waits in real time, whatever clock tells the deadlines.
    drain_until_ = steady_clock().now() + patience;
    draining_ = true;
    sockets_->ring();
    io_thread_.join();
    dispatcher_->abandon();
    return answered();
  }

  ServerCounters counters() const {
    ServerCounters counters;
    counters.uptime_s = std::chrono::duration<double>(clock_.now() - started_).count();
    counters.requests = requests_;
    counters.errors = errors_;
    counters.refused = refused_;
    counters.expired = expired_;
    counters.malformed = malformed_;
    counters.undelivered = outbox_.undelivered();
    counters.in_flight = admission_.in_flight();
    counters.queued_cells = dispatcher_->queued_cells();
    counters.cells_by_client = dispatcher_->cells_by_client();
    return counters;
  }

 private:
  bool answered() const { return admission_.in_flight() == 0 && outbox_.empty(); }

  // --- the I/O thread ---

  void run_io() {
    for (;;) {
      bool received = false;
      try {
        sockets_->wait(draining_ || !outbox_.empty() ? kSoon : kIdle);
        received = receive_some();
        send_finished();
      } catch (const std::exception& error) {
        log_error(fmt::format("I/O: {}", error.what()));
      }
      // Requests are let in by this thread alone: none can slip in after the last look.
      if (draining_ && ((answered() && !received) || steady_clock().now() >= drain_until_)) {
        return;
      }
    }
  }

  /// A bounded number, so that a flood of requests does not hold up the replies.
  bool receive_some() {
    constexpr int kMost = 100;
    for (int i = 0; i < kMost; ++i) {
      std::optional<Incoming> incoming = sockets_->receive();
      if (!incoming) return i > 0;
      take(*std::move(incoming));
    }
    sockets_->ring();
    return true;
  }

  void take(Incoming incoming) {
    v1::RequestHeader header;
    if (Status status = read_header(incoming, &header); !status) {
      return refuse(incoming, header.request_id(), std::move(status).error());
    }
    if (Status status = admit(incoming, header); !status) {
      return refuse(incoming, header.request_id(), std::move(status).error());
    }
    const std::uint32_t budget_ms = header.deadline_ms() == 0
                                        ? config_.default_deadline_ms
                                        : std::min(header.deadline_ms(), config_.max_deadline_ms);
    const std::size_t bytes = incoming.body.size();
    admission_.enter(incoming.client, bytes);
    Request request{incoming.client,
                    header.client_name(),
                    header.method(),
                    std::move(incoming.body),
                    clock_.now() + std::chrono::milliseconds(budget_ms)};
    dispatcher_->submit(std::move(request),
                        planning_cells(header.method()),
                        [this,
                         client = std::move(incoming.client),
                         delimiter = incoming.delimiter,
                         id = header.request_id(),
                         bytes](Result<std::string> result) {
                          finish({reply_of(client, delimiter, id, std::move(result)), bytes});
                        });
  }

  /// @errors kDataLoss: frames or header cannot be read; those of `protocol::validate`.
  Status read_header(const Incoming& incoming, v1::RequestHeader* header) {
    if (!incoming.well_formed) {
      ++malformed_;
      // The header, if there is one, tells the sender which request this was.
      if (!header->ParseFromString(incoming.header)) header->Clear();
      return fail(Error{ErrorCode::kDataLoss,
                        fmt::format("frames: {}; expected a header and a body", incoming.frames),
                        "frames"});
    }
    Result<v1::RequestHeader> parsed =
        protocol::parse<v1::RequestHeader>(incoming.header, "header");
    if (!parsed) {
      ++malformed_;
      return fail(std::move(parsed).error());
    }
    *header = *std::move(parsed);
    ++requests_;
    return protocol::validate(*header);
  }

  /// @errors kUnavailable: the server is shutting down; those of `Admission::check`.
  Status admit(const Incoming& incoming, const v1::RequestHeader& header) {
    if (draining_) {
      return fail(Error{ErrorCode::kUnavailable,
                        "the server is shutting down",
                        "",
                        "send it again when the server is back",
                        kRetryAfter_ms});
    }
    return admission_.check(incoming.client,
                            header.method(),
                            incoming.body.size(),
                            outbox_.waiting(incoming.client),
                            dispatcher_->queued_cells());
  }

  void refuse(const Incoming& incoming, std::uint64_t request_id, Error error) {
    outbox_.deliver(
        reply_of(incoming.client, incoming.delimiter, request_id, fail(std::move(error))));
  }

  void send_finished() {
    std::deque<Finished> finished;
    std::vector<Event> events;
    {
      const std::lock_guard lock(finished_mutex_);
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

  // --- any thread ---

  Outgoing reply_of(const std::string& client,
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

  void finish(Finished finished) {
    {
      const std::lock_guard lock(finished_mutex_);
      finished_.push_back(std::move(finished));
    }
    sockets_->ring();
  }

  void announce(const service::JobStatus& status) {
    v1::Event event;
    event.set_server_epoch(config_.epoch);
    *event.mutable_job() = protocol::to_wire(progress_of(services_, status));
    {
      const std::lock_guard lock(finished_mutex_);
      events_.push_back({"job/" + wire_id(services_, status.id), event.SerializeAsString()});
    }
    sockets_->ring();
  }

  // --- the jobs' thread ---

  void wake_jobs() {
    {
      const std::lock_guard lock(jobs_mutex_);
      jobs_waiting_ = true;
    }
    jobs_wanted_.notify_all();
  }

  void run_jobs() {
    for (;;) {
      {
        std::unique_lock lock(jobs_mutex_);
        jobs_wanted_.wait(lock, [this] { return jobs_waiting_ || jobs_ending_; });
        if (jobs_ending_) return;
        jobs_waiting_ = false;
      }
      while (services_.jobs.run_next()) {
      }
    }
  }

  const ServerConfig config_;
  const Clock& clock_;
  const TimePoint started_;
  std::unique_ptr<Sockets> sockets_;
  Services services_;
  const std::string endpoint_;
  const std::string events_endpoint_;
  std::unique_ptr<Dispatcher> dispatcher_;

  // Of the I/O thread, but for their counts.
  Admission admission_;
  Outbox outbox_;

  std::mutex finished_mutex_;  ///< guards finished_, events_
  std::deque<Finished> finished_;
  std::vector<Event> events_;

  std::mutex jobs_mutex_;  ///< guards jobs_waiting_, jobs_ending_
  std::condition_variable jobs_wanted_;
  bool jobs_waiting_ = false;
  bool jobs_ending_ = false;

  std::mutex drain_mutex_;
  TimePoint drain_until_;  ///< set before draining_
  std::atomic<bool> draining_{false};
  std::atomic<std::uint64_t> requests_{0};
  std::atomic<std::uint64_t> errors_{0};
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<std::uint64_t> expired_{0};
  std::atomic<std::uint64_t> malformed_{0};
  std::thread jobs_thread_;
  std::thread io_thread_;
};

Result<std::unique_ptr<Server>> Server::start(const ServerConfig& config,
                                              service::MapRegistry maps,
                                              const Clock& clock) {
  SocketConfig sockets;
  sockets.bind = config.bind;
  sockets.events = config.events;
  sockets.max_message_bytes = config.limits.max_message_bytes;
  SEMVIEW_TRY(std::unique_ptr<Sockets> bound, Sockets::bind(sockets));
  return std::unique_ptr<Server>(
      new Server(std::make_unique<Parts>(config, std::move(maps), std::move(bound), clock)));
}

Server::Server(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Server::~Server() = default;

const std::string& Server::endpoint() const { return parts_->endpoint(); }
const std::string& Server::events_endpoint() const { return parts_->events_endpoint(); }
bool Server::drain(std::chrono::milliseconds patience) { return parts_->drain(patience); }
ServerCounters Server::counters() const { return parts_->counters(); }

}  // namespace semview::server
