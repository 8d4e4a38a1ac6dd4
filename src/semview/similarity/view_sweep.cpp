// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/view_sweep.hpp"

#include <algorithm>
#include <atomic>

#include <fmt/format.h>

namespace semview::similarity {
namespace {

/// About 16 MB of views.
constexpr std::size_t kChunkCells = 4096;
/// A third of a millisecond of full compasses: far above the cost of taking a task.
constexpr std::size_t kGrainCells = 64;

}  // namespace

Result<ViewOrigins> sweep_views(
    const PreparedObservation& observation,
    ViewSource& views,
    std::span<const CellIndex> cells,
    ThreadPool& pool,
    const std::function<void(std::size_t i, const ColumnView* view)>& visit,
    const std::function<bool(std::size_t done)>& progress) {
  ViewOrigins origins;
  for (std::size_t first = 0; first < cells.size(); first += kChunkCells) {
    const auto chunk = cells.subspan(first, std::min(kChunkCells, cells.size() - first));
    SEMVIEW_TRY(const ViewBatch batch, views.views(chunk));
    if (batch.views.size() != chunk.size()) {
      return fail(ErrorCode::kInternal,
                  fmt::format("{} views came for {} cells", batch.views.size(), chunk.size()));
    }
    std::atomic<bool> misfit = false;
    pool.parallel_for(chunk.size(), kGrainCells, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const ColumnView* const view = batch.views[i].get();
        if (view != nullptr && !observation.fits(*view)) {
          misfit = true;
        } else {
          visit(first + i, view);
        }
      }
    });
    if (misfit) {
      return fail(ErrorCode::kInternal, "a view is not of the observation's map and view profile");
    }
    origins += batch.origins;
    if (progress && !progress(first + chunk.size())) {
      return fail(ErrorCode::kCancelled, "scoring was cancelled");
    }
  }
  return origins;
}

}  // namespace semview::similarity
