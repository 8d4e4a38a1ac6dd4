// SPDX-License-Identifier: Apache-2.0
#include "fair_queue.hpp"

#include <algorithm>
#include <chrono>

namespace semview::server {

bool FairQueue::push(const std::string& client, Task task) {
  task.cells = std::max<std::uint64_t>(task.cells, 1);
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return false;
    queued_cells_ += task.cells;
    const auto [entry, added] = clients_.try_emplace(client);
    if (added) {
      // A client that has just had its share keeps its place; one that was away gains nothing.
      entry->second.served = served_at_arrival(client);
      ahead_.erase(client);
      turns_.emplace(std::pair(entry->second.served, client), &entry->second);
    }
    entry->second.expected += task.expected;
    entry->second.tasks.push_back(std::move(task));
  }
  has_task_.notify_one();
  return true;
}

std::optional<Task> FairQueue::pop() {
  std::unique_lock lock(mutex_);
  has_task_.wait(lock, [this] { return closed_ || !turns_.empty(); });
  if (turns_.empty()) return std::nullopt;
  const auto first = turns_.begin();
  const std::string name = first->first.second;
  Client& client = *first->second;
  turns_.erase(first);
  Task task = std::move(client.tasks.front());
  const auto cells = static_cast<double>(task.cells);
  // Who is ahead has had this share already, and counts among those who divide it.
  const auto sharing = static_cast<double>(clients_.size() + ahead_.size());
  now_ = std::max(now_ + cells / sharing, client.served);
  std::erase_if(ahead_, [this](const auto& entry) { return entry.second <= now_; });
  client.tasks.pop_front();
  queued_cells_ -= task.cells;
  client.expected -= task.expected;
  client.served += cells;
  if (!client.tasks.empty()) {
    turns_.emplace(std::pair(client.served, name), &client);
    return task;
  }
  if (client.served > now_) ahead_[name] = client.served;
  clients_.erase(name);
  if (turns_.empty()) ahead_.clear();  // nobody waits: nobody owes anything
  return task;
}

void FairQueue::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  has_task_.notify_all();
}

std::uint64_t FairQueue::queued_cells() const {
  const std::lock_guard lock(mutex_);
  return queued_cells_;
}

Duration FairQueue::expected_wait(const std::string& client, std::uint64_t cells) const {
  const std::lock_guard lock(mutex_);
  const auto own = clients_.find(client);
  double last = static_cast<double>(cells);
  if (own == clients_.end()) {
    last += served_at_arrival(client);
  } else {
    last += own->second.served + static_cast<double>(own->second.expected.cells);
  }
  Duration wait{};
  for (const auto& [name, other] : clients_) {
    const Work& work = other.expected;
    const double share = std::max(last - other.served, 0.0);
    const auto all = static_cast<double>(work.cells);
    if (name == client || share >= all) {
      wait += work.time;
    } else {
      wait += std::chrono::duration_cast<Duration>(share / all * work.time);
    }
  }
  return wait;
}

double FairQueue::served_at_arrival(const std::string& client) const {
  const auto found = ahead_.find(client);
  return found == ahead_.end() ? now_ : std::max(now_, found->second);
}

}  // namespace semview::server
