// SPDX-License-Identifier: Apache-2.0
#include "client/load/kernel_time.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <unordered_map>

#include "semview/core/thread_pool.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "semview/similarity/score_poses.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace semview::client {
namespace {

constexpr int kRounds = 3;

/// Views in a table.
class FetchedViews final : public ViewSource {
 public:
  static Result<FetchedViews> fetch(ViewSource& source, const std::vector<CellIndex>& cells) {
    SEMVIEW_TRY(const ViewBatch batch, source.views(cells));
    FetchedViews fetched(source.profile());
    for (std::size_t i = 0; i < cells.size(); ++i) fetched.views_[cells[i]] = batch.views[i];
    return fetched;
  }

  const ViewProfile& profile() const override { return profile_; }
  Result<ViewBatch> views(std::span<const CellIndex> cells) override {
    ViewBatch batch;
    batch.views.reserve(cells.size());
    for (const CellIndex& cell : cells) batch.views.push_back(views_.at(cell));
    return batch;
  }

 private:
  explicit FetchedViews(ViewProfile profile) : profile_(profile) {}

  ViewProfile profile_;
  std::unordered_map<CellIndex, SharedView> views_;
};

double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

}  // namespace

double KernelTime::robots(std::size_t cores, double rate_hz) const {
  return 1000.0 * static_cast<double>(cores) / (rate_hz * cycle_ms());
}

Result<KernelTime> kernel_time(const LoadWork& work, ViewSource& views) {
  SEMVIEW_TRY(FetchedViews fetched, FetchedViews::fetch(views, work.cells()));
  ThreadPool alone(1);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  KernelTime best{kInfinity, kInfinity};
  for (int round = 0; round < kRounds; ++round) {
    KernelTime sum;
    for (const LoadWork::Place& place : work.places()) {
      auto start = std::chrono::steady_clock::now();
      SEMVIEW_TRY(
          const auto prepared,
          similarity::PreparedObservation::build(
              place.observation, work.weights(), work.map_classes(), views.profile().camera));
      sum.prepare_ms += ms_since(start);
      start = std::chrono::steady_clock::now();
      SEMVIEW_TRY([[maybe_unused]] const ScoreBatch scores,
                  similarity::score_poses(prepared, fetched, place.request, alone));
      sum.score_ms += ms_since(start);
    }
    const auto count = static_cast<double>(work.places().size());
    best.prepare_ms = std::min(best.prepare_ms, sum.prepare_ms / count);
    best.score_ms = std::min(best.score_ms, sum.score_ms / count);
  }
  return best;
}

}  // namespace semview::client
