// SPDX-License-Identifier: Apache-2.0
/// Worker threads and the parallel loop over them.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace semview {

/// A fixed set of worker threads.
///
/// @threads All members are safe to call from several threads, a worker included.
class ThreadPool {
 public:
  /// `threads` counts the caller of `parallel_for` as one: 1 makes no thread at all and runs
  /// everything in the caller; 0 takes the number of cores. If fewer can be made, a line says so.
  explicit ThreadPool(std::size_t threads = 0);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  std::size_t threads() const { return workers_.size() + 1; }

  /// Calls `body(begin, end)` on ranges of at most `grain` that cover [0, count), on the caller
  /// and on idle workers, and returns when all are done. Which thread runs which range is not
  /// defined: results must not depend on it. `body` must not throw.
  void parallel_for(std::size_t count,
                    std::size_t grain,
                    const std::function<void(std::size_t begin, std::size_t end)>& body);

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable has_work_;
  std::deque<std::function<void()>> queue_;
  bool stopping_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace semview
