// SPDX-License-Identifier: Apache-2.0
#include "semview/service/jobs.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "semview/service/site.hpp"

namespace semview::service {

struct Jobs::Job {
  std::shared_ptr<Site> site;
  PrecomputePlan plan;
  std::stop_source stop;
  JobStatus status;
};

std::string_view name(JobState state) {
  switch (state) {
    case JobState::kQueued:
      return "queued";
    case JobState::kRunning:
      return "running";
    case JobState::kDone:
      return "done";
    case JobState::kFailed:
      return "failed";
    case JobState::kCancelled:
      return "cancelled";
  }
  return "unknown";
}

Jobs::Jobs(const Limits& limits) : limits_(limits) {}

void Jobs::on_change(std::function<void(const JobStatus&)> listener) {
  listener_ = std::move(listener);
}

Result<std::uint64_t> Jobs::start_precompute(std::shared_ptr<Site> site,
                                             const PrecomputeRegion& region) {
  if (site->tiers().store == nullptr) {
    return fail(Error{ErrorCode::kFailedPrecondition,
                      "the server was started without --cache: it has no place to keep views",
                      {},
                      "start it again with a cache directory, for example semview-server --map DIR "
                      "--cache /var/cache/semview"});
  }
  const auto job = std::make_shared<Job>();
  SEMVIEW_TRY(job->plan, plan_precompute(*site, region));
  job->status.map_id = site->id();
  job->status.progress.cells = job->plan.cells.size();
  job->site = std::move(site);
  JobStatus announced;  // the job may be running before it is announced
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return fail(ErrorCode::kUnavailable, "the server is shutting down");
    if (counters_.running >= limits_.max_running_jobs) {
      return fail(Error{ErrorCode::kResourceExhausted,
                        fmt::format("{} jobs are waiting or running already", counters_.running),
                        {},
                        "wait for one or cancel one",
                        1000});
    }
    job->status.id = next_id_++;
    jobs_.emplace(job->status.id, job);
    ++counters_.running;
    forget_old_jobs();
    announced = job->status;
  }
  announce(announced);
  return announced.id;
}

Result<JobStatus> Jobs::status(std::uint64_t id) const {
  const std::lock_guard lock(mutex_);
  const auto found = jobs_.find(id);
  if (found == jobs_.end()) {
    return fail(Error{ErrorCode::kNotFound, fmt::format("no job {}", id), "job_id"});
  }
  return found->second->status;
}

std::vector<JobStatus> Jobs::list() const {
  const std::lock_guard lock(mutex_);
  std::vector<JobStatus> list;
  for (const auto& [id, job] : jobs_) list.push_back(job->status);
  return list;
}

Status Jobs::cancel(std::uint64_t id) {
  std::shared_ptr<Job> job;
  {
    const std::lock_guard lock(mutex_);
    const auto found = jobs_.find(id);
    if (found == jobs_.end()) {
      return fail(Error{ErrorCode::kNotFound, fmt::format("no job {}", id), "job_id"});
    }
    job = found->second;
  }
  job->stop.request_stop();
  finish(*job, JobState::kQueued, JobState::kCancelled, {});
  return {};
}

void Jobs::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  for (const JobStatus& job : list()) static_cast<void>(cancel(job.id));
}

bool Jobs::run_next() {
  std::shared_ptr<Job> job;
  {
    const std::lock_guard lock(mutex_);
    const auto waiting = std::ranges::find_if(
        jobs_, [](const auto& entry) { return entry.second->status.state == JobState::kQueued; });
    if (waiting == jobs_.end()) return false;
    job = waiting->second;
    job->status.state = JobState::kRunning;
  }
  const Result<PrecomputeResult> result = run_precompute(
      *job->site, job->plan, job->stop.get_token(), [&](const PrecomputeProgress& progress) {
        JobStatus status;
        {
          const std::lock_guard lock(mutex_);
          job->status.progress = progress;
          status = job->status;
        }
        announce(status);
      });
  if (!result) {
    finish(*job, JobState::kRunning, JobState::kFailed, result.error());
  } else if (result->end == PrecomputeEnd::kStopped) {
    finish(*job, JobState::kRunning, JobState::kCancelled, {});
  } else {
    finish(*job, JobState::kRunning, JobState::kDone, {});
  }
  return true;
}

Jobs::Counters Jobs::counters() const {
  const std::lock_guard lock(mutex_);
  return counters_;
}

/// Ends a job that is in state `from`; one in another state stays as it is.
void Jobs::finish(Job& job, JobState from, JobState to, Error error) {
  JobStatus status;
  {
    const std::lock_guard lock(mutex_);
    if (job.status.state != from) return;
    job.status.state = to;
    job.status.error = std::move(error);
    --counters_.running;
    if (to == JobState::kDone) ++counters_.done;
    if (to == JobState::kFailed) ++counters_.failed;
    if (to == JobState::kCancelled) ++counters_.cancelled;
    status = job.status;
  }
  announce(status);
}

/// Forgets the oldest jobs that have ended; called with the lock held.
void Jobs::forget_old_jobs() {
  for (auto job = jobs_.begin(); job != jobs_.end();) {
    if (jobs_.size() <= limits_.max_running_jobs + limits_.max_finished_jobs) return;
    const JobState state = job->second->status.state;
    const bool ended = state != JobState::kQueued && state != JobState::kRunning;
    job = ended ? jobs_.erase(job) : std::next(job);
  }
}

void Jobs::announce(const JobStatus& status) const {
  if (listener_) listener_(status);
}

}  // namespace semview::service
