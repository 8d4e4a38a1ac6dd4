// SPDX-License-Identifier: Apache-2.0
/// The queue between the I/O thread and the workers.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "work_costs.hpp"

namespace semview::server {

/// A piece of work and what it is reckoned to cost.
struct Task {
  std::uint64_t cells = 1;  ///< estimate, at least 1: views to score, cast or send
  std::function<void()> run;
  Work expected = {};  ///< all that comes of it: of a request not planned yet the whole
};

/// Gives every client the same share of the workers, measured in cells and not in requests.
///
/// Each client has a first-in-first-out queue. `pop` takes the next task of the client that has had
/// the least work; one that comes back from idling has no credit for the time away. So a client
/// with one small request waits for one task of each other client at most, whatever they have
/// queued; and what waits is not overtaken by ever more newcomers: they begin where a client would
/// be that had been there and had its share.
/// @threads All members from several threads at once.
class FairQueue {
 public:
  /// False, and the task is not taken, if the queue is closed.
  bool push(const std::string& client, Task task);

  /// The next task in turn; waits for one. `nullopt` once the queue is closed and empty.
  std::optional<Task> pop();

  /// No more tasks come in; those inside are still given out.
  void close();

  std::uint64_t queued_cells() const;

  /// How long one worker is expected to take for what is given out before the last of `cells` more
  /// of this client: its own tasks, and of each other client's no more than their share.
  /// @cost O(clients with a task waiting)
  Duration expected_wait(const std::string& client, std::uint64_t cells) const;

 private:
  struct Client {
    std::deque<Task> tasks;
    Work expected;        ///< of `tasks`
    double served = 0.0;  ///< virtual time: cells given out, level with others at arrival
  };
  /// (served, client): the first is next.
  using Turns = std::map<std::pair<double, std::string>, Client*>;

  /// What `served` of a client is that now comes with its first task.
  double served_at_arrival(const std::string& client) const;

  mutable std::mutex mutex_;
  std::condition_variable has_task_;
  std::unordered_map<std::string, Client> clients_;  ///< those with a task waiting
  Turns turns_;
  double now_ = 0.0;  ///< `served` of one that always has tasks waiting: its share of all cells
  /// `served` of clients whose queue ran empty, while it is ahead of `now_`.
  std::unordered_map<std::string, double> ahead_;
  std::uint64_t queued_cells_ = 0;
  bool closed_ = false;
};

}  // namespace semview::server
