// SPDX-License-Identifier: Apache-2.0
/// Long work that a client starts, watches and cancels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/service/limits.hpp"
#include "semview/service/precompute.hpp"

namespace semview::service {

class Site;

enum class JobState { kQueued, kRunning, kDone, kFailed, kCancelled };

/// "queued", "running", "done", "failed" or "cancelled".
std::string_view name(JobState state);

struct JobStatus {
  std::uint64_t id = 0;
  std::string map_id;
  JobState state = JobState::kQueued;
  PrecomputeProgress progress;
  Error error;  ///< of a failed job
};

/// Precompute jobs. This class makes no thread: whoever owns it (the server) calls `run_next` from
/// a thread of its own, one job a call.
/// @threads All members from several threads at once.
class Jobs {
 public:
  explicit Jobs(const Limits& limits);

  /// Called after each change of a job's status, in the thread that made it; set it before use.
  void on_change(std::function<void(const JobStatus&)> listener);

  /// @errors kFailedPrecondition: no cache directory; those of `plan_precompute`;
  /// kResourceExhausted: `max_running_jobs` are waiting or running; kUnavailable: closed.
  Result<std::uint64_t> start_precompute(std::shared_ptr<Site> site,
                                         const PrecomputeRegion& region);

  /// @errors kNotFound
  Result<JobStatus> status(std::uint64_t id) const;
  std::vector<JobStatus> list() const;

  /// Stops a waiting or running job; one that has ended stays as it is.
  /// @errors kNotFound
  Status cancel(std::uint64_t id);
  /// Stops all jobs, and refuses new ones with kUnavailable from now on.
  void close();

  /// Runs the oldest waiting job to its end; false if none waits.
  bool run_next();

  struct Counters {
    std::size_t running = 0;  ///< or waiting
    std::uint64_t done = 0;
    std::uint64_t failed = 0;
    std::uint64_t cancelled = 0;
  };
  Counters counters() const;

 private:
  struct Job;
  void finish(Job& job, JobState from, JobState to, Error error);
  void forget_old_jobs();
  void announce(const JobStatus& status) const;

  const Limits limits_;
  std::function<void(const JobStatus&)> listener_;
  mutable std::mutex mutex_;
  std::map<std::uint64_t, std::shared_ptr<Job>> jobs_;
  std::uint64_t next_id_ = 1;
  bool closed_ = false;
  Counters counters_;
};

}  // namespace semview::service
