// SPDX-License-Identifier: Apache-2.0
#include "fair_queue.hpp"

#include <algorithm>

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
      entry->second.served = now_;
      if (const auto found = ahead_.find(client); found != ahead_.end()) {
        entry->second.served = std::max(now_, found->second);
        ahead_.erase(found);
      }
      turns_.emplace(std::pair(entry->second.served, client), &entry->second);
    }
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
  now_ = client.served;
  Task task = std::move(client.tasks.front());
  client.tasks.pop_front();
  queued_cells_ -= task.cells;
  client.served += task.cells;
  if (!client.tasks.empty()) {
    turns_.emplace(std::pair(client.served, name), &client);
    return task;
  }
  ahead_[name] = client.served;
  clients_.erase(name);
  if (turns_.empty()) {
    // Nobody waits: nobody owes anything.
    ahead_.clear();
  } else {
    std::erase_if(ahead_, [this](const auto& entry) { return entry.second <= now_; });
  }
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

}  // namespace semview::server
