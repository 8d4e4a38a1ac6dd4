// SPDX-License-Identifier: Apache-2.0
#include "semview/core/thread_pool.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>
#include <system_error>

#include "semview/core/check.hpp"
#include "semview/core/log.hpp"

namespace semview {
namespace {

/// One `parallel_for`, shared by the caller and the workers that help it. A worker that comes late
/// finds no range left and lets go, so the loop never waits for a busy worker.
class Loop {
 public:
  Loop(std::size_t count,
       std::size_t grain,
       const std::function<void(std::size_t, std::size_t)>& body)
      : count_(count), grain_(grain), body_(body) {}

  void run_ranges() {
    for (;;) {
      const std::size_t begin = next_.fetch_add(grain_);
      if (begin >= count_) return;
      const std::size_t end = std::min(begin + grain_, count_);
      body_(begin, end);
      const std::lock_guard lock(mutex_);
      done_ += end - begin;
      if (done_ == count_) finished_.notify_all();
    }
  }

  void wait() {
    std::unique_lock lock(mutex_);
    finished_.wait(lock, [this] { return done_ == count_; });
  }

 private:
  const std::size_t count_;
  const std::size_t grain_;
  // Lives in the caller's frame: used only for ranges that the caller waits for.
  const std::function<void(std::size_t, std::size_t)>& body_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::condition_variable finished_;
  std::size_t done_ = 0;
};

}  // namespace

ThreadPool::ThreadPool(std::size_t threads) {
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  try {
    for (std::size_t i = 1; i < threads; ++i) workers_.emplace_back([this] { work(); });
  } catch (const std::system_error& error) {
    log_warning("of " + std::to_string(threads) + " threads only " +
                std::to_string(workers_.size() + 1) + " could be made: " + error.code().message());
  }
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  has_work_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::parallel_for(std::size_t count,
                              std::size_t grain,
                              const std::function<void(std::size_t, std::size_t)>& body) {
  SEMVIEW_CHECK(grain > 0);
  if (count == 0) return;
  const std::size_t ranges = (count + grain - 1) / grain;
  if (workers_.empty() || ranges == 1) {
    for (std::size_t begin = 0; begin < count; begin += grain) {
      body(begin, std::min(begin + grain, count));
    }
    return;
  }
  const auto loop = std::make_shared<Loop>(count, grain, body);
  {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < std::min(workers_.size(), ranges - 1); ++i) {
      queue_.emplace_back([loop] { loop->run_ranges(); });
    }
  }
  has_work_.notify_all();
  loop->run_ranges();
  loop->wait();
}

void ThreadPool::work() {
  for (;;) {
    std::function<void()> task;
    {
      std::unique_lock lock(mutex_);
      has_work_.wait(lock, [this] { return stopping_ || !queue_.empty(); });
      if (stopping_) return;
      task = std::move(queue_.front());
      queue_.pop_front();
    }
    task();
  }
}

}  // namespace semview
