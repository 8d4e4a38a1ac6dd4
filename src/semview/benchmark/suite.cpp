// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/suite.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "semview/benchmark/measurement.hpp"
#include "semview/raycast/engine_choice.hpp"

namespace semview::benchmark {
namespace {

using detail::Extent;
using detail::RowKind;

/// A plan that is made when the first row needs it.
class LazySubject {
 public:
  using Load = std::function<Result<std::shared_ptr<const Subject>>()>;
  LazySubject(std::string name, bool drawn, Load load)
      : name_(std::move(name)), drawn_(drawn), load_(std::move(load)) {}

  const std::string& name() const { return name_; }
  bool drawn() const { return drawn_; }
  /// The error, too, is found once.
  const Result<std::shared_ptr<const Subject>>& get() {
    if (!made_) made_ = load_();
    return *made_;
  }
  void forget() { made_.reset(); }

 private:
  std::string name_;
  bool drawn_;
  Load load_;
  std::optional<Result<std::shared_ptr<const Subject>>> made_;
};

LazySubject office(const std::string& name, double width_m, double depth_m, double resolution_m) {
  OfficePlan plan;
  plan.width_m = width_m;
  plan.depth_m = depth_m;
  plan.resolution_m = resolution_m;
  return {name, true, [name, plan] { return prepare_subject(name, plan); }};
}

Result<std::vector<LazySubject>> subjects_of(const SuiteConfig& config) {
  std::vector<LazySubject> subjects;
  if (config.quick) {
    subjects.push_back(office("office 15 x 12.5 m, 10 cm", 15.0, 12.5, 0.1));
  } else {
    subjects.push_back(office("office 40 x 25 m, 5 cm", 40.0, 25.0, 0.05));
    subjects.push_back(office("office 40 x 25 m, 2 cm", 40.0, 25.0, 0.02));
    subjects.push_back(office("office 1 ha, 5 cm", 100.0, 100.0, 0.05));
  }
  for (const std::filesystem::path& path : config.maps) {
    SEMVIEW_TRY(map::SemanticMap map, map::load_map(path));
    const bool drawn = map.columns() != nullptr;
    auto shared = std::make_shared<map::SemanticMap>(std::move(map));
    subjects.emplace_back(
        shared->id, drawn, [shared] { return prepare_subject(shared->id, *shared); });
  }
  return subjects;
}

std::vector<RowKind> all_kinds() {
  std::vector<RowKind> kinds = detail::cast_rows();
  for (auto* more : {&detail::score_rows,
                     &detail::floor_rows,
                     &detail::storage_rows,
                     &detail::site_rows,
                     &detail::memory_rows,
                     &detail::served_rows}) {
    for (RowKind& kind : (*more)()) kinds.push_back(std::move(kind));
  }
  return kinds;
}

Extent extent_of(const SuiteConfig& config) {
  Extent extent;
  extent.turns.budget_s = config.budget_s;
  if (config.quick) {
    extent = {.views = 2,
              .slow_views = 1,
              .cells = 4,
              .slow_cells = 1,
              .floor_cells = 32,
              .stored_cells = 8,
              .precomputed_cells = 24,
              .cold_cells = 2,
              .served_cells = 10,
              .served_poses = 40,
              .turns = {.budget_s = 0.0, .fewest_rounds = 1, .most_rounds = 1}};
  }
  return extent;
}

struct Job {
  const RowKind* kind = nullptr;
  LazySubject* subject = nullptr;
  PanoramaCamera camera;
  Row row;
};

bool worth_it(const RowKind& kind, const LazySubject& subject, bool first) {
  if (kind.plans == detail::Plans::kFirst) return first;
  return kind.plans == detail::Plans::kAll || subject.drawn();
}

std::vector<Job> jobs_of(const SuiteConfig& config,
                         const std::vector<RowKind>& kinds,
                         std::vector<LazySubject>& subjects) {
  const std::vector<int> columns = config.quick ? std::vector{120, 240} : std::vector{360, 720};
  std::vector<Job> jobs;
  for (LazySubject& subject : subjects) {
    for (const RowKind& kind : kinds) {
      const bool wanted =
          config.only.empty() || std::ranges::find(config.only, kind.id) != config.only.end();
      if (!wanted || !worth_it(kind, subject, &subject == &subjects.front())) continue;
      for (std::size_t size = 0; size < std::max<std::size_t>(1, kind.goals.size()); ++size) {
        for (const std::size_t threads : config.threads) {
          if (kind.one_thread_only && threads != config.threads.front()) continue;
          Job job{&kind, &subject, camera_of(columns[size]), {}};
          job.row.id = kind.id;
          job.row.claim = kind.claim;
          job.row.subject = subject.name();
          job.row.size = fmt::format("{}x{}", job.camera.columns, job.camera.rows);
          job.row.threads = static_cast<int>(kind.one_thread_only ? 1 : threads);
          if (size < kind.goals.size() && !config.quick) job.row.goal = kind.goals[size];
          jobs.push_back(std::move(job));
        }
      }
    }
  }
  return jobs;
}

Status check(const SuiteConfig& config, const std::vector<RowKind>& kinds) {
  SEMVIEW_TRY_STATUS(raycast::check_engine_name(config.engine));
  std::vector<std::string> ids;
  for (const RowKind& kind : kinds) ids.push_back(kind.id);
  for (const std::string& wanted : config.only) {
    if (std::ranges::find(ids, wanted) != ids.end()) continue;
    return fail(
        Error{ErrorCode::kInvalidArgument,
              fmt::format("--only {}: no such row; there are {}", wanted, fmt::join(ids, ", ")),
              "--only"});
  }
  for (const std::size_t threads : config.threads) {
    if (threads >= 1 && threads <= 256) continue;
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("--threads {}: expected 1 to 256", threads),
                      "--threads"});
  }
  return {};
}

/// A plan that cannot be measured costs its own rows and no others.
Status measure(Job& job, ThreadPool& pool, const Extent& extent, const SuiteConfig& config) {
  SEMVIEW_TRY(const std::shared_ptr<const Subject> subject, job.subject->get());
  return job.kind->measure({*subject, job.camera, pool, extent, config.engine, config.serve},
                           job.row);
}

}  // namespace

Status detail::without_peer(const Error& error, Row& row) {
  if (error.code != ErrorCode::kNotFound) return fail(error);
  row.note = error.message;
  return {};
}

Goal detail::at_least(double ratio, std::optional<double> then) {
  std::string text = fmt::format("at least {:g}x", ratio);
  if (then) text += fmt::format(", then {:g}x", *then);
  return {std::move(text), ratio, then};
}

std::vector<Claim> claims() {
  std::vector<Claim> claims;
  for (const RowKind& kind : all_kinds()) claims.push_back({kind.id, kind.claim});
  return claims;
}

Result<std::vector<Row>> run_suite(const SuiteConfig& config,
                                   const std::function<void(const Progress&)>& progress) {
  const std::vector<RowKind> kinds = all_kinds();
  SEMVIEW_TRY_STATUS(check(config, kinds));
  SEMVIEW_TRY(std::vector<LazySubject> subjects, subjects_of(config));
  std::vector<Job> jobs = jobs_of(config, kinds, subjects);
  const Extent extent = extent_of(config);
  std::map<int, std::unique_ptr<ThreadPool>> pools;
  std::vector<Row> rows;
  const double begin_s = now_s();
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    Job& job = jobs[i];
    if (config.stopped && config.stopped()) break;
    const double elapsed_s = now_s() - begin_s;
    const auto left = static_cast<double>(jobs.size() - i);
    // What making plans and comparing results takes beside the time that is measured.
    constexpr double kPreparation_s = 0.6;
    const double each_s =
        i < 4 ? config.budget_s + kPreparation_s : elapsed_s / static_cast<double>(i);
    progress({i, jobs.size(), elapsed_s, left * each_s, &job.row});
    if (i > 0 && jobs[i - 1].subject != job.subject) jobs[i - 1].subject->forget();
    std::unique_ptr<ThreadPool>& pool = pools[job.row.threads];
    if (pool == nullptr)
      pool = std::make_unique<ThreadPool>(static_cast<std::size_t>(job.row.threads));
    if (const Status status = measure(job, *pool, extent, config); !status) {
      job.row.note = status.error().message;
      job.row.failed = true;
      job.row.disagrees = status.error().code == ErrorCode::kInternal;
    }
    rows.push_back(std::move(job.row));
  }
  return rows;
}

}  // namespace semview::benchmark
