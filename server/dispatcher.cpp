// SPDX-License-Identifier: Apache-2.0
#include "dispatcher.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace semview::server {
namespace {

constexpr std::size_t kMaxCountedClients = 1000;

/// What `body` returns, or kInternal if it throws.
template <typename T, typename Body>
Result<T> guarded(const std::string& method, const Body& body) {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kResourceExhausted, fmt::format("{}: out of memory", method));
  } catch (const std::exception& error) {
    return fail(ErrorCode::kInternal, fmt::format("{}: {}", method, error.what()));
  }
}

}  // namespace

/// One request under way; its tasks share it.
class Dispatcher::Run : public std::enable_shared_from_this<Run> {
 public:
  Run(Dispatcher& dispatcher, Request request, Reply reply)
      : dispatcher_(dispatcher), request_(std::move(request)), reply_(std::move(reply)) {}

  void make_plan(std::uint64_t cells) {
    if (expired()) return;
    const TimePoint begin = dispatcher_.clock_.now();
    Result<Plan> plan =
        guarded<Plan>(request_.method, [this] { return dispatcher_.planner_(request_); });
    dispatcher_.count(request_.client_name, cells);
    if (!plan) return end(fail(std::move(plan).error()));
    request_.body = {};
    plan_ = *std::move(plan);
    std::uint64_t cells_to_come = 0;
    for (const Chunk& chunk : plan_.chunks) cells_to_come += chunk.cells;
    dispatcher_.costs_.add_request(
        request_.client, request_.method, {cells, dispatcher_.clock_.now() - begin}, cells_to_come);
    remaining_ = plan_.chunks.size();
    if (plan_.chunks.empty()) return finish();
    for (std::size_t i = 1; i < plan_.chunks.size(); ++i) push(i);
    // Last: this task may see the plan through, and end the run.
    push(0);
  }

 private:
  void push(std::size_t index) {
    const std::uint64_t cells = plan_.chunks[index].cells;
    Task task{cells,
              [self = shared_from_this(), index] { self->run_chunk(index); },
              dispatcher_.costs_.of_part(request_.client, request_.method, cells)};
    // A closed queue means that the server is being taken down: its workers still empty it, and
    // this worker sees to what can no longer be queued.
    if (!dispatcher_.queue_.push(request_.client, std::move(task))) run_chunk(index);
  }

  void run_chunk(std::size_t index) {
    Chunk& chunk = plan_.chunks[index];
    if (!over_ && !expired()) {
      const TimePoint begin = dispatcher_.clock_.now();
      Status status = guarded<void>(request_.method, chunk.run);
      dispatcher_.count(request_.client_name, chunk.cells);
      // An error may come long before the work is done: it tells nothing.
      if (status) {
        dispatcher_.costs_.add_part(
            request_.client, request_.method, {chunk.cells, dispatcher_.clock_.now() - begin});
      } else {
        end(fail(std::move(status).error()));
      }
    }
    if (--remaining_ == 0 && !over_) finish();
  }

  /// Ends the run if its time is up.
  bool expired() {
    if (dispatcher_.abandoned_) {
      end(fail(ErrorCode::kUnavailable, "the server is shutting down"));
      return true;
    }
    if (dispatcher_.clock_.now() <= request_.deadline) return false;
    end(fail(Error{ErrorCode::kDeadlineExceeded,
                   fmt::format("{}: the deadline passed before the work was done", request_.method),
                   "deadline_ms"}));
    return true;
  }

  void finish() { end(guarded<std::string>(request_.method, plan_.finish)); }

  void end(Result<std::string> result) {
    if (!over_.exchange(true)) reply_(std::move(result));
  }

  Dispatcher& dispatcher_;
  Request request_;
  const Reply reply_;
  Plan plan_;
  std::atomic<std::size_t> remaining_{0};
  std::atomic<bool> over_{false};
};

Dispatcher::Dispatcher(std::size_t workers, Planner planner, const Clock& clock)
    : planner_(std::move(planner)), clock_(clock) {
  for (std::size_t i = 0; i < std::max<std::size_t>(workers, 1); ++i) {
    workers_.emplace_back([this] {
      while (std::optional<Task> task = queue_.pop()) task->run();
    });
  }
}

Dispatcher::~Dispatcher() {
  queue_.close();
  for (std::thread& worker : workers_) worker.join();
}

void Dispatcher::submit(Request request, std::uint64_t cells, Reply reply) {
  const std::string client = request.client;
  const Work expected = costs_.of_purpose(client, request.method);
  const auto run = std::make_shared<Run>(*this, std::move(request), std::move(reply));
  queue_.push(client, {cells, [run, cells] { run->make_plan(cells); }, expected});
}

Duration Dispatcher::expected_wait(const std::string& client, std::uint64_t cells) const {
  return queue_.expected_wait(client, cells) / static_cast<Duration::rep>(workers_.size());
}

Duration Dispatcher::expected_wait(const std::string& client, const std::string& method) const {
  return expected_wait(client, costs_.of_purpose(client, method).cells);
}

void Dispatcher::count(const std::string& client_name, std::uint64_t cells) {
  const std::lock_guard lock(mutex_);
  const bool known = cells_by_client_.contains(client_name);
  const bool room = cells_by_client_.size() < kMaxCountedClients;
  cells_by_client_[known || room ? client_name : "(others)"] += cells;
}

std::map<std::string, std::uint64_t> Dispatcher::cells_by_client() const {
  const std::lock_guard lock(mutex_);
  return cells_by_client_;
}

}  // namespace semview::server
