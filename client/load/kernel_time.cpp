// SPDX-License-Identifier: Apache-2.0
#include "client/load/kernel_time.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <vector>

#include "semview/similarity/prepared_observation.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace semview::client {
namespace {

constexpr int kRounds = 3;

/// A cell of a request: what the kernel is called with.
struct CellWork {
  SharedView view;                     ///< never null
  std::vector<std::uint8_t> headings;  ///< distinct, sorted; empty: all
};

using Views = std::unordered_map<CellIndex, SharedView>;

Result<Views> fetch(ViewSource& source, const std::vector<CellIndex>& cells) {
  SEMVIEW_TRY(const ViewBatch batch, source.views(cells));
  Views fetched;
  for (std::size_t i = 0; i < cells.size(); ++i) fetched[cells[i]] = batch.views[i];
  return fetched;
}

/// The poses of a request as the scorer takes them: each cell once, in the order of cells.
std::vector<CellWork> group(const ScoreRequest& request, const Views& views) {
  std::map<CellIndex, std::set<std::uint8_t>> cells;
  for (const Pose2& pose : request.poses) {
    const std::optional<GridKey> key = PoseGrid::key(pose);
    if (key) cells[key->cell].insert(static_cast<std::uint8_t>(key->heading));
  }
  std::vector<CellWork> work;
  for (const auto& [cell, headings] : cells) {
    const auto found = views.find(cell);
    if (found == views.end() || found->second == nullptr) continue;
    work.push_back({found->second, {}});
    if (request.mode == HeadingMode::kAsGiven) {
      work.back().headings.assign(headings.begin(), headings.end());
    }
  }
  return work;
}

/// All sums added up, so that none can be left out.
std::int64_t sweep(const similarity::PreparedObservation& observation,
                   const std::vector<CellWork>& work) {
  std::array<std::int32_t, PoseGrid::kHeadings> sums{};
  std::int64_t total = 0;
  for (const CellWork& cell : work) {
    if (!observation.fits(*cell.view)) continue;
    if (cell.headings.empty()) {
      observation.all_headings(*cell.view, sums);
    } else {
      observation.some_headings(
          *cell.view, cell.headings, std::span(sums).first(cell.headings.size()));
    }
    total += sums[0];
  }
  return total;
}

double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

}  // namespace

double KernelTime::robots(std::size_t cores, double rate_hz) const {
  return 1000.0 * static_cast<double>(cores) / (rate_hz * cycle_ms());
}

Result<KernelTime> kernel_time(const LoadWork& work, ViewSource& views) {
  SEMVIEW_TRY(const Views fetched, fetch(views, work.cells()));
  std::vector<std::vector<CellWork>> cells;
  for (const LoadWork::Place& place : work.places()) cells.push_back(group(place.request, fetched));
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  volatile std::int64_t sink = 0;  // keeps the sums
  KernelTime best{kInfinity, kInfinity};
  for (int round = 0; round < kRounds; ++round) {
    KernelTime sum;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      auto start = std::chrono::steady_clock::now();
      SEMVIEW_TRY(const auto prepared,
                  similarity::PreparedObservation::build(work.places()[i].observation,
                                                         work.weights(),
                                                         work.map_classes(),
                                                         views.profile().camera));
      sum.prepare_ms += ms_since(start);
      start = std::chrono::steady_clock::now();
      sink = sink + sweep(prepared, cells[i]);
      sum.score_ms += ms_since(start);
    }
    const auto count = static_cast<double>(cells.size());
    best.prepare_ms = std::min(best.prepare_ms, sum.prepare_ms / count);
    best.score_ms = std::min(best.score_ms, sum.score_ms / count);
  }
  return best;
}

}  // namespace semview::client
