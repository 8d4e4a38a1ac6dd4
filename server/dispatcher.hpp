// SPDX-License-Identifier: Apache-2.0
/// Carries requests from receipt to their one reply, over the workers.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "fair_queue.hpp"
#include "plan.hpp"
#include "semview/core/clock.hpp"
#include "semview/core/result.hpp"
#include "work_costs.hpp"

namespace semview::server {

/// A request whose header was found good.
struct Request {
  std::string client;       ///< who shares the workers: the connection's identity
  std::string client_name;  ///< as it calls itself, for the statistics
  std::string method;
  std::string body;
  TimePoint deadline;
};

/// Makes a plan of a request; called by a worker.
using Planner = std::function<Result<Plan>(const Request&)>;
/// Takes the reply's body or the error; called exactly once, by a worker.
using Reply = std::function<void(Result<std::string>)>;

/// Worker threads on a FairQueue.
///
/// Planning is a task, each chunk of the plan is one; a request whose deadline has passed or that
/// has failed lets its other chunks go by without doing them. An exception from a plan or a chunk
/// becomes kInternal.
class Dispatcher {
 public:
  Dispatcher(std::size_t workers, Planner planner, const Clock& clock);
  /// Answers everything inside, then ends the workers.
  ~Dispatcher();
  Dispatcher(const Dispatcher&) = delete;
  Dispatcher& operator=(const Dispatcher&) = delete;

  /// `cells` is the first estimate of the planning itself.
  void submit(Request request, std::uint64_t cells, Reply reply);

  /// From now on nothing more is begun: what waits ends with kUnavailable.
  void abandon() { abandoned_ = true; }

  std::uint64_t queued_cells() const { return queue_.queued_cells(); }

  /// How long it is expected to take until the workers turn to the last of `cells` more of this
  /// client. @threads any
  Duration expected_wait(const std::string& client, std::uint64_t cells) const;
  /// The same of a request that nobody has looked at yet; of a SetObservation until the Score that
  /// follows is done, without which nobody has use for it.
  Duration expected_wait(const std::string& client, const std::string& method) const;

  /// Cells of finished chunks and plans by client name; the names beyond a thousand are together
  /// under "(others)".
  std::map<std::string, std::uint64_t> cells_by_client() const;

 private:
  class Run;

  void count(const std::string& client_name, std::uint64_t cells);

  FairQueue queue_;
  const Planner planner_;
  const Clock& clock_;
  WorkCosts costs_;
  std::atomic<bool> abandoned_{false};
  mutable std::mutex mutex_;
  std::map<std::string, std::uint64_t> cells_by_client_;
  std::vector<std::thread> workers_;
};

}  // namespace semview::server
