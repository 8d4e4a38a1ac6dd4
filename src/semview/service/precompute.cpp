// SPDX-License-Identifier: Apache-2.0
#include "semview/service/precompute.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <span>
#include <string>

#include <fmt/format.h>

#include "semview/cache/cache_key.hpp"
#include "semview/cache/lmdb_store.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/service/nearest_eye_view_source.hpp"
#include "semview/service/site.hpp"

namespace semview::service {
namespace {

// Between two chunks `stop` is obeyed. What a thread casts is still in its processor's cache when
// it is coded.
constexpr std::size_t kChunkCellsAThread = 32;
constexpr std::size_t kChunkPixels = 256 * 360 * 90;
// One transaction and one progress line for chunks of so long or so many cells: a commit waits for
// the disk, which with a fast engine would take as long as casting a chunk.
constexpr double kCommitAfter_s = 0.1;
constexpr std::size_t kMaxCommitCells = 2048;
constexpr std::size_t kSampleCells = 48;

double seconds_between(TimePoint from, TimePoint to) {
  return std::chrono::duration<double>(to - from).count();
}

Result<std::vector<CellIndex>> cells_in(const map::CellGrid& grid,
                                        const std::array<double, 4>& rectangle_m) {
  const auto [x0, y0, x1, y1] = rectangle_m;
  if (!(x0 < x1 && y0 < y1)) {
    return fail(Error{
        ErrorCode::kInvalidArgument,
        fmt::format("region {:g},{:g},{:g},{:g}: x0 < x1 and y0 < y1 expected", x0, y0, x1, y1),
        "--region"});
  }
  std::vector<CellIndex> cells = grid.free_cells();
  std::erase_if(cells, [&](const CellIndex& cell) {
    const Pose2 center = PoseGrid::center(cell);
    return !(center.x_m >= x0 && center.x_m < x1 && center.y_m >= y0 && center.y_m < y1);
  });
  return cells;
}

Result<std::vector<CellIndex>> cells_around(const map::CellGrid& grid,
                                            const std::array<double, 2>& place_m) {
  const auto cell = PoseGrid::cell(place_m[0], place_m[1]);
  std::vector<CellIndex> cells = cell ? grid.reachable_from(*cell) : std::vector<CellIndex>();
  if (cells.empty()) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("{:g},{:g} is not in free space", place_m[0], place_m[1]),
                      "--reachable-from"});
  }
  return cells;
}

std::size_t chunk_cells(const Site& site) {
  const PanoramaCamera& camera = site.profile().camera;
  const std::size_t pixels =
      static_cast<std::size_t>(camera.columns) * static_cast<std::size_t>(camera.rows);
  const std::size_t threads = site.pool().threads();
  return std::clamp(kChunkPixels / pixels, threads, threads * kChunkCellsAThread);
}

Result<cache::LmdbStore*> store_of(const Site& site) {
  if (cache::LmdbStore* store = site.tiers().store.get()) return store;
  return fail(Error{ErrorCode::kFailedPrecondition,
                    "precomputed views need a cache directory",
                    "--cache",
                    "name one: --cache DIR"});
}

/// Casts cells with the engine, in parallel, and makes their records, in parallel too.
Result<std::vector<cache::EncodedView>> cast(const Site& site,
                                             const Fingerprint& keyspace,
                                             std::span<const CellIndex> cells) {
  SEMVIEW_TRY(const ViewBatch batch, site.engine_views().views(cells));
  std::vector<cache::EncodedView> encoded(cells.size());
  site.pool().parallel_for(cells.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      encoded[i] = cache::LmdbStore::encode(keyspace, cells[i], *batch.views[i]);
    }
  });
  return encoded;
}

/// What a record takes in the data file: records stored in order share full pages.
double bytes_on_disk(double record_bytes) {
  constexpr double kPage = 4096.0;
  constexpr double kPageRoom = kPage - 16.0;
  constexpr double kEntry = 24.0 + 10.0;  // key, node header, pointer
  if (record_bytes > kPageRoom / 2.0 - kEntry) {
    return std::ceil((record_bytes + 16.0) / kPage) * kPage + kEntry + 8.0;
  }
  return kPage / std::floor(kPageRoom / (record_bytes + kEntry));
}

}  // namespace

Result<PrecomputePlan> plan_precompute(const Site& site, const PrecomputeRegion& region) {
  if (region.rectangle_m && region.reachable_from_m) {
    return fail(Error{
        ErrorCode::kInvalidArgument, "a rectangle or a place to reach from, not both", "--region"});
  }
  const map::CellGrid& grid = site.cells();
  std::vector<CellIndex> free;
  if (region.rectangle_m) {
    SEMVIEW_TRY(free, cells_in(grid, *region.rectangle_m));
  } else if (region.reachable_from_m) {
    SEMVIEW_TRY(free, cells_around(grid, *region.reachable_from_m));
  } else {
    free = grid.free_cells();
  }
  PrecomputePlan plan;
  plan.free_cells = free.size();
  plan.cells = view_cells(grid, free);
  if (plan.cells.empty()) {
    return fail(Error{ErrorCode::kNotFound,
                      fmt::format("map {}: no free cell there", site.id()),
                      region.rectangle_m ? "--region" : ""});
  }
  return plan;
}

Result<PrecomputeResult> run_precompute(
    const Site& site,
    const PrecomputePlan& plan,
    std::stop_token stop,
    const std::function<void(const PrecomputeProgress&)>& progress,
    const Clock& clock) {
  SEMVIEW_TRY(cache::LmdbStore* const store, store_of(site));
  const Fingerprint keyspace = cache::digest(site.keyspace());
  const std::vector<CellIndex> missing = store->missing(site.keyspace(), plan.cells);
  PrecomputeResult result;
  PrecomputeProgress& now = result.progress;
  now.cells = plan.cells.size();
  now.found = plan.cells.size() - missing.size();
  if (progress) progress(now);

  const TimePoint start = clock.now();
  const std::size_t chunk = chunk_cells(site);
  std::vector<cache::EncodedView> waiting;
  TimePoint committed = start;
  const auto commit = [&]() -> Status {
    SEMVIEW_TRY_STATUS(store->put_encoded(site.keyspace(), waiting));
    for (const cache::EncodedView& view : waiting) now.bytes += view.record.size();
    now.cast += waiting.size();
    waiting.clear();
    committed = clock.now();
    now.elapsed_s = seconds_between(start, committed);
    if (now.elapsed_s > 0.0) now.views_per_s = static_cast<double>(now.cast) / now.elapsed_s;
    now.remaining_s = now.elapsed_s * static_cast<double>(missing.size() - now.cast) /
                      static_cast<double>(now.cast);
    if (progress) progress(now);
    return {};
  };
  for (std::size_t begin = 0; begin < missing.size(); begin += chunk) {
    if (stop.stop_requested()) {
      if (!waiting.empty()) SEMVIEW_TRY_STATUS(commit());
      result.end = PrecomputeEnd::kStopped;
      return result;
    }
    const auto cells = std::span(missing).subspan(begin, std::min(chunk, missing.size() - begin));
    SEMVIEW_TRY(std::vector<cache::EncodedView> encoded, cast(site, keyspace, cells));
    std::move(encoded.begin(), encoded.end(), std::back_inserter(waiting));
    // The first at once: whoever watches sees that it runs.
    if (begin == 0 || begin + chunk >= missing.size() || waiting.size() >= kMaxCommitCells ||
        seconds_between(committed, clock.now()) >= kCommitAfter_s) {
      SEMVIEW_TRY_STATUS(commit());
    }
  }
  return result;
}

Result<PrecomputeEstimate> estimate_precompute(const Site& site,
                                               const PrecomputePlan& plan,
                                               const Clock& clock) {
  PrecomputeEstimate estimate;
  estimate.cells = plan.cells.size();
  const std::vector<CellIndex> missing =
      site.tiers().store ? site.tiers().store->missing(site.keyspace(), plan.cells) : plan.cells;
  estimate.found = plan.cells.size() - missing.size();
  if (missing.empty()) return estimate;

  std::vector<CellIndex> sample;
  const std::size_t step = std::max<std::size_t>(1, missing.size() / kSampleCells);
  for (std::size_t i = 0; i < missing.size(); i += step) sample.push_back(missing[i]);
  const TimePoint start = clock.now();
  SEMVIEW_TRY(const std::vector<cache::EncodedView> encoded,
              cast(site, cache::digest(site.keyspace()), sample));
  const double elapsed_s = seconds_between(start, clock.now());
  double bytes = 0.0;
  for (const cache::EncodedView& view : encoded) {
    bytes += static_cast<double>(view.record.size());
  }
  const auto sampled = static_cast<double>(sample.size());
  const auto wanted = static_cast<double>(missing.size());
  estimate.sampled = sample.size();
  estimate.seconds = elapsed_s / sampled * wanted;
  estimate.bytes = static_cast<std::uint64_t>(bytes_on_disk(bytes / sampled) * wanted);
  return estimate;
}

}  // namespace semview::service
