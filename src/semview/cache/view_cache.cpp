// SPDX-License-Identifier: Apache-2.0
#include "semview/cache/view_cache.hpp"

#include <exception>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "semview/core/check.hpp"

namespace semview::cache {
namespace {

/// Views of a request's distinct cells, filled tier by tier.
struct Request {
  std::vector<CellIndex> cells;      // distinct, in order of their first appearance
  std::vector<std::size_t> cell_of;  // request index → index into `cells`
  std::vector<SharedView> views;     // one a distinct cell
  ViewOrigins origins;

  explicit Request(std::span<const CellIndex> requested) {
    std::unordered_map<CellIndex, std::size_t> index;
    index.reserve(requested.size());
    cell_of.reserve(requested.size());
    for (const CellIndex& cell : requested) {
      const auto [entry, is_new] = index.try_emplace(cell, cells.size());
      if (is_new) cells.push_back(cell);
      cell_of.push_back(entry->second);
    }
    views.resize(cells.size());
  }

  std::vector<CellIndex> cells_at(std::span<const std::size_t> indices) const {
    std::vector<CellIndex> chosen;
    chosen.reserve(indices.size());
    for (const std::size_t i : indices) chosen.push_back(cells[i]);
    return chosen;
  }

  /// Asks a tier for the cells at `indices`; returns those that it does not have.
  std::vector<std::size_t> fill_from(ViewStore& tier,
                                     const Keyspace& keyspace,
                                     const std::vector<std::size_t>& indices,
                                     std::uint64_t& hits) {
    if (indices.empty()) return {};
    std::vector<SharedView> found = tier.get(keyspace, cells_at(indices));
    std::vector<std::size_t> missing;
    for (std::size_t k = 0; k < indices.size(); ++k) {
      if (found[k] == nullptr) {
        missing.push_back(indices[k]);
      } else {
        views[indices[k]] = std::move(found[k]);
        ++hits;
      }
    }
    return missing;
  }

  void put_into(ViewStore& tier,
                const Keyspace& keyspace,
                const std::vector<std::size_t>& indices) const {
    std::vector<CellIndex> put_cells;
    std::vector<SharedView> put_views;
    for (const std::size_t i : indices) {
      if (views[i] == nullptr) continue;  // a cell without a view: asked again, cheap to say again
      put_cells.push_back(cells[i]);
      put_views.push_back(views[i]);
    }
    if (!put_cells.empty()) tier.put(keyspace, put_cells, put_views);
  }

  ViewBatch answer() const {
    ViewBatch batch;
    batch.origins = origins;
    batch.views.reserve(cell_of.size());
    for (const std::size_t i : cell_of) batch.views.push_back(views[i]);
    return batch;
  }
};

Result<std::vector<SharedView>> call(const ComputeViews& compute,
                                     std::span<const CellIndex> cells) {
  try {
    Result<std::vector<SharedView>> views = compute(cells);
    if (views && views->size() != cells.size()) {
      return fail(ErrorCode::kInternal,
                  fmt::format("{} views computed for {} cells", views->size(), cells.size()));
    }
    return views;
  } catch (const std::exception& error) {
    return fail(ErrorCode::kInternal, fmt::format("computing views: {}", error.what()));
  } catch (...) {
    return fail(ErrorCode::kInternal, "computing views: unknown exception");
  }
}

std::vector<std::size_t> all_indices(std::size_t count) {
  std::vector<std::size_t> indices(count);
  for (std::size_t i = 0; i < count; ++i) indices[i] = i;
  return indices;
}

}  // namespace

ViewCache::ViewCache(std::shared_ptr<ViewStore> memory,
                     std::shared_ptr<ViewStore> disk,
                     std::shared_ptr<ViewStore> distorted)
    : memory_(std::move(memory)), disk_(std::move(disk)), distorted_(std::move(distorted)) {
  SEMVIEW_CHECK(memory_ != nullptr);
}

Result<ViewBatch> ViewCache::get_or_compute(const Keyspace& keyspace,
                                            std::span<const CellIndex> cells,
                                            const ComputeViews& compute) {
  const bool distorted = !keyspace.affine.is_identity();
  ViewStore& memory = distorted && distorted_ != nullptr ? *distorted_ : *memory_;
  ViewStore* const disk = distorted ? nullptr : disk_.get();
  Request request(cells);
  ViewOrigins& origins = request.origins;
  const std::vector<std::size_t> missing =
      request.fill_from(memory, keyspace, all_indices(request.cells.size()), origins.memory);
  if (missing.empty()) return request.answer();

  const Fingerprint keyspace_name = digest(keyspace);
  std::vector<ViewKey> keys;
  keys.reserve(missing.size());
  for (const std::size_t i : missing) keys.push_back({keyspace_name, request.cells[i]});
  auto claim = flights_.claim(keys);
  waits_ += claim.awaited();

  std::vector<std::size_t> mine;
  for (const std::size_t k : claim.mine()) mine.push_back(missing[k]);
  // Another thread may have finished a cell between the first look and the claim.
  const std::vector<std::size_t> unknown =
      request.fill_from(memory, keyspace, mine, origins.memory);
  const std::vector<std::size_t> uncast =
      disk == nullptr ? unknown : request.fill_from(*disk, keyspace, unknown, origins.disk);
  if (!uncast.empty()) {
    Result<std::vector<SharedView>> cast = call(compute, request.cells_at(uncast));
    if (!cast) {
      ++failed_;
      claim.fail(cast.error());
      return fail(std::move(cast).error());
    }
    for (std::size_t k = 0; k < uncast.size(); ++k) {
      request.views[uncast[k]] = std::move((*cast)[k]);
    }
    origins.cast += uncast.size();
    cast_ += uncast.size();
  }
  request.put_into(memory, keyspace, unknown);
  std::vector<SharedView> made;
  made.reserve(mine.size());
  for (const std::size_t i : mine) made.push_back(request.views[i]);
  claim.complete(std::move(made));
  // Waiters have their answer before the slow part.
  if (disk != nullptr) request.put_into(*disk, keyspace, uncast);

  SEMVIEW_TRY_STATUS(claim.wait([&](std::size_t k, const SharedView& view) {
    request.views[missing[k]] = view;
    ++origins.memory;
  }));
  return request.answer();
}

ViewCacheCounters ViewCache::counters() const {
  ViewCacheCounters counters;
  counters.memory = memory_->counters();
  if (distorted_ != nullptr) counters.memory += distorted_->counters();
  if (disk_ != nullptr) counters.disk = disk_->counters();
  counters.cast = cast_;
  counters.waits = waits_;
  counters.failed = failed_;
  return counters;
}

}  // namespace semview::cache
