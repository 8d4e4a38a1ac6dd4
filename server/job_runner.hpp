// SPDX-License-Identifier: Apache-2.0
/// The thread of the long jobs.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "semview/service/jobs.hpp"

namespace semview::server {

/// Runs the jobs that wait, one after the other, in a thread of its own.
/// @threads `wake` from any thread.
class JobRunner {
 public:
  /// `jobs` must outlive the runner.
  explicit JobRunner(service::Jobs& jobs);
  ~JobRunner();
  JobRunner(const JobRunner&) = delete;
  JobRunner& operator=(const JobRunner&) = delete;

  /// A job was started.
  void wake();
  /// Closes the jobs and ends the thread.
  void stop();

 private:
  void run();

  service::Jobs& jobs_;
  std::mutex mutex_;  ///< guards waiting_, ending_
  std::condition_variable wanted_;
  bool waiting_ = false;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace semview::server
