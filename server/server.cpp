// SPDX-License-Identifier: Apache-2.0
#include "server.hpp"

#include <mutex>
#include <thread>
#include <utility>

#include "admission.hpp"
#include "dispatcher.hpp"
#include "job_runner.hpp"
#include "reception.hpp"
#include "semview/protocol/map_wire.hpp"
#include "semview/v1/jobs.pb.h"
#include "sockets.hpp"

namespace semview::server {
namespace {

constexpr std::chrono::milliseconds kDrainOfDestructor{5000};

}  // namespace

class Server::Parts {
 public:
  Parts(const ServerConfig& config,
        service::MapRegistry maps,
        std::unique_ptr<Sockets> sockets,
        const Clock& clock)
      : epoch_(config.epoch),
        clock_(clock),
        started_(clock.now()),
        reception_(config, std::move(sockets), clock),
        services_(std::move(maps), config.limits, config.epoch),
        job_runner_(services_.jobs),
        dispatcher_(
            config.workers == 0 ? std::thread::hardware_concurrency() : config.workers,
            [this](const Request& request) { return plan_request(services_, request); },
            clock) {
    services_.default_deadline_ms = config.default_deadline_ms;
    services_.max_deadline_ms = config.max_deadline_ms;
    services_.events_port = reception_.sockets().events_port();
    services_.counters = [this] { return counters(); };
    services_.queued_cells = [this] { return dispatcher_.queued_cells(); };
    services_.check_wait = [this](const Request& request, std::uint64_t cells) {
      return check_wait(request.method,
                        dispatcher_.expected_wait(request.client, cells),
                        request.deadline - clock_.now());
    };
    services_.job_was_started = [this] { job_runner_.wake(); };
    services_.jobs.on_change([this](const service::JobStatus& status) { announce(status); });
    io_thread_ = std::thread([this] { reception_.run(dispatcher_); });
  }

  ~Parts() { drain(kDrainOfDestructor); }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  const Sockets& sockets() const { return reception_.sockets(); }

  bool drain(std::chrono::milliseconds patience) {
    const std::lock_guard only_one(drain_mutex_);
    if (io_thread_.joinable()) {
      job_runner_.stop();
      reception_.close(steady_clock().now() + patience);
      io_thread_.join();
      dispatcher_.abandon();
    }
    return reception_.all_answered();
  }

  ServerCounters counters() const {
    ServerCounters counters;
    reception_.count_into(&counters);
    counters.uptime_s = std::chrono::duration<double>(clock_.now() - started_).count();
    counters.queued_cells = dispatcher_.queued_cells();
    counters.cells_by_client = dispatcher_.cells_by_client();
    return counters;
  }

 private:
  void announce(const service::JobStatus& status) {
    v1::Event event;
    event.set_server_epoch(epoch_);
    *event.mutable_job() = protocol::to_wire(progress_of(services_, status));
    reception_.publish("job/" + wire_id(services_, status.id), event.SerializeAsString());
  }

  const std::uint64_t epoch_;
  const Clock& clock_;
  const TimePoint started_;
  std::mutex drain_mutex_;

  // Each ends its threads when it is destroyed, and these use only what stands above: replies go to
  // the reception, jobs to their runner. Workers ask the dispatcher, too, which is there until the
  // last of them has ended.
  Reception reception_;
  Services services_;
  JobRunner job_runner_;
  Dispatcher dispatcher_;
  std::thread io_thread_;
};

Result<std::unique_ptr<Sockets>> Server::bind(const ServerConfig& config) {
  return Sockets::bind(
      {config.bind, config.events, config.events_port, config.limits.max_message_bytes});
}

std::unique_ptr<Server> Server::serve(const ServerConfig& config,
                                      std::unique_ptr<Sockets> sockets,
                                      service::MapRegistry maps,
                                      const Clock& clock) {
  return std::unique_ptr<Server>(
      new Server(std::make_unique<Parts>(config, std::move(maps), std::move(sockets), clock)));
}

Result<std::unique_ptr<Server>> Server::start(const ServerConfig& config,
                                              service::MapRegistry maps,
                                              const Clock& clock) {
  SEMVIEW_TRY(std::unique_ptr<Sockets> sockets, bind(config));
  return serve(config, std::move(sockets), std::move(maps), clock);
}

Server::Server(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Server::~Server() = default;

const std::string& Server::endpoint() const { return parts_->sockets().endpoint(); }
const std::string& Server::events_endpoint() const { return parts_->sockets().events_endpoint(); }
bool Server::drain(std::chrono::milliseconds patience) { return parts_->drain(patience); }
ServerCounters Server::counters() const { return parts_->counters(); }

}  // namespace semview::server
