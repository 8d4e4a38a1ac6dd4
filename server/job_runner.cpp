// SPDX-License-Identifier: Apache-2.0
#include "job_runner.hpp"

namespace semview::server {

JobRunner::JobRunner(service::Jobs& jobs) : jobs_(jobs), thread_([this] { run(); }) {}

JobRunner::~JobRunner() { stop(); }

void JobRunner::wake() {
  {
    const std::lock_guard lock(mutex_);
    waiting_ = true;
  }
  wanted_.notify_all();
}

void JobRunner::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  jobs_.close();
  wanted_.notify_all();
  thread_.join();
}

void JobRunner::run() {
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      wanted_.wait(lock, [this] { return waiting_ || ending_; });
      if (ending_) return;
      waiting_ = false;
    }
    while (jobs_.run_next()) {
    }
  }
}

}  // namespace semview::server
