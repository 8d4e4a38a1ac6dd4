// SPDX-License-Identifier: Apache-2.0
#include "client/load/open_loop.hpp"

#include <algorithm>
#include <deque>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/protocol/envelope.hpp"
#include "semview/v1/scores.pb.h"

namespace semview::client {
namespace {

double ms_of(Duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

tl::unexpected<Error> wrong(std::string_view option, std::string message) {
  return fail(Error{ErrorCode::kInvalidArgument, std::move(message), std::string(option)});
}

/// One run. Cycle i is that of robot i modulo their number, and is due i / (robots · rate) after
/// the start.
class OpenLoop {
 public:
  OpenLoop(const LoadConfig& config, const LoadBodies& bodies, LoadWire& wire, const Clock& clock)
      : config_(config), bodies_(bodies), wire_(wire), clock_(clock), start_(clock.now()) {
    const double total_hz = config.rate_hz * static_cast<double>(config.robots);
    interval_ = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(1.0 / total_hz));
    report_.seconds = config.seconds;
    report_.cycles = static_cast<std::size_t>(std::max(config.seconds * total_hz, 1.0));
    times_ms_.assign(report_.cycles, ms_of(config.timeout));
    over_.assign(report_.cycles, false);
  }

  LoadReport run() && {
    for (;;) {
      begin_due();
      give_up_late();
      if (begun_ == report_.cycles && waiting_.empty()) break;
      if (const auto reply = wire_.receive(next_event())) take(*reply);
    }
    add_percentiles(std::move(times_ms_), &report_);
    return report_;
  }

 private:
  TimePoint due(std::size_t cycle) const {
    return start_ + interval_ * static_cast<Duration::rep>(cycle);
  }
  std::size_t robot_of(std::size_t cycle) const { return cycle % config_.robots; }
  std::size_t turn_of(std::size_t cycle) const { return cycle / config_.robots; }

  void begin_due() {
    for (; begun_ < report_.cycles && due(begun_) <= clock_.now(); ++begun_) {
      const double late_ms = ms_of(clock_.now() - due(begun_));
      report_.worst_start_ms = std::max(report_.worst_start_ms, late_ms);
      send(begun_, "SetObservation", bodies_.observation(robot_of(begun_), turn_of(begun_)));
      waiting_.push_back(begun_);
    }
  }

  void send(std::size_t cycle, std::string_view method, std::string_view body) {
    open_.emplace(++last_id_, Open{cycle, method == "SetObservation"});
    wire_.send(robot_of(cycle), last_id_, method, body, time_left(cycle));
  }

  std::chrono::milliseconds time_left(std::size_t cycle) const {
    return std::max(
        std::chrono::floor<std::chrono::milliseconds>(due(cycle) + config_.in_time - clock_.now()),
        std::chrono::milliseconds(1));
  }

  /// Cycles in the order of their beginning: the first is the first whose time is up.
  void give_up_late() {
    while (!waiting_.empty() &&
           (over_[waiting_.front()] || due(waiting_.front()) + config_.timeout <= clock_.now())) {
      if (!over_[waiting_.front()]) ++report_.timed_out;
      over_[waiting_.front()] = true;
      waiting_.pop_front();
    }
  }

  TimePoint next_event() const {
    TimePoint next = clock_.now() + config_.timeout;
    if (!waiting_.empty()) next = std::min(next, due(waiting_.front()) + config_.timeout);
    if (begun_ < report_.cycles) next = std::min(next, due(begun_));
    return next;
  }

  void take(const LoadReply& reply) {
    const auto found = open_.find(reply.request_id);
    if (found == open_.end()) return;
    const Open open = found->second;
    open_.erase(found);
    if (over_[open.cycle]) return;
    if (!reply.body) {
      over_[open.cycle] = true;
      ++count_of(reply.body.error().code);
      return;
    }
    if (!open.observing) return end(open.cycle);
    const auto observed = protocol::parse<v1::SetObservationReply>(*reply.body, "reply");
    if (!observed) {
      over_[open.cycle] = true;
      ++report_.failed;
      return;
    }
    send(open.cycle,
         "Score",
         bodies_.score(robot_of(open.cycle), turn_of(open.cycle), observed->observation_id()));
  }

  std::size_t& count_of(ErrorCode code) {
    if (code == ErrorCode::kResourceExhausted) return report_.refused;
    if (code == ErrorCode::kDeadlineExceeded) return report_.timed_out;
    return report_.failed;
  }

  void end(std::size_t cycle) {
    const Duration took = clock_.now() - due(cycle);
    if (took > config_.timeout) return;  // given up at the next look
    over_[cycle] = true;
    times_ms_[cycle] = ms_of(took);
    ++report_.answered;
    if (took <= config_.in_time) ++report_.in_time;
  }

  struct Open {
    std::size_t cycle = 0;
    bool observing = true;
  };

  const LoadConfig& config_;
  const LoadBodies& bodies_;
  LoadWire& wire_;
  const Clock& clock_;
  const TimePoint start_;
  Duration interval_{};
  LoadReport report_;
  std::vector<double> times_ms_;     ///< one a cycle; the time limit until it is answered
  std::vector<bool> over_;           ///< one a cycle
  std::size_t begun_ = 0;            ///< cycles
  std::deque<std::size_t> waiting_;  ///< cycles begun and, but for some at the front, not over
  std::unordered_map<std::uint64_t, Open> open_;  ///< requests without a reply
  std::uint64_t last_id_ = 0;
};

}  // namespace

Status validate(const LoadConfig& config) {
  if (config.robots < 1 || config.robots > kMaxRobots) {
    return wrong("--robots",
                 fmt::format("--robots {}: expected 1 to {}", config.robots, kMaxRobots));
  }
  // Written so that NaN fails.
  if (!(config.rate_hz > 0.0 && config.rate_hz <= 100.0)) {
    return wrong("--rate", fmt::format("--rate {:g}: expected above 0 to 100 Hz", config.rate_hz));
  }
  if (!(config.seconds > 0.0 && config.seconds <= 600.0)) {
    return wrong("--seconds",
                 fmt::format("--seconds {:g}: expected above 0 to 600", config.seconds));
  }
  const double cycles = config.seconds * config.rate_hz * static_cast<double>(config.robots);
  if (cycles > kMaxCycles) {
    return wrong("--seconds",
                 fmt::format("--seconds {:g}: {:.0f} cycles; expected at most {:.0f}",
                             config.seconds,
                             cycles,
                             kMaxCycles));
  }
  return {};
}

Result<LoadReport> run_open_loop(const LoadConfig& config,
                                 const LoadBodies& bodies,
                                 LoadWire& wire,
                                 const Clock& clock) {
  SEMVIEW_TRY_STATUS(validate(config));
  return OpenLoop(config, bodies, wire, clock).run();
}

}  // namespace semview::client
