// SPDX-License-Identifier: Apache-2.0
/// The one door to cached views: memory, then disk, then the caller's own way to make them.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "semview/cache/cache_key.hpp"
#include "semview/cache/single_flight.hpp"
#include "semview/cache/view_store.hpp"
#include "semview/view/view_source.hpp"

namespace semview::cache {

/// Makes the views of cells that no tier has: one a cell in the order given, null where there is
/// none. Called with distinct cells.
using ComputeViews = std::function<Result<std::vector<SharedView>>(std::span<const CellIndex>)>;

struct ViewCacheCounters {
  StoreCounters memory;      ///< of both tiers in memory
  StoreCounters disk;        ///< all zero without a disk tier
  std::uint64_t cast = 0;    ///< views made by a compute function
  std::uint64_t waits = 0;   ///< cells that another thread was already making
  std::uint64_t failed = 0;  ///< compute functions that failed
};

/// Two tiers and single flight: a view that several threads want at once is made once.
///
/// Views of maps taken to be distorted have a tier of their own and never go to the disk: while a
/// distortion is being estimated there are hundreds a frame, seen once each, and they must not push
/// out the views of the map as it is.
///
/// Nothing here knows how a view is made.
/// @threads All members from several threads at once.
class ViewCache {
 public:
  /// `disk` may be null. Without `distorted` the views of distorted maps are in `memory`.
  ViewCache(std::shared_ptr<ViewStore> memory,
            std::shared_ptr<ViewStore> disk,
            std::shared_ptr<ViewStore> distorted = nullptr);

  /// The views of `cells`, which may repeat. `origins` counts distinct cells; a cell that another
  /// thread was making counts as from memory.
  /// @errors those of `compute`, its own or that of the thread that was making a cell; a thrown
  /// exception becomes kInternal. Every waiting thread is answered on every path.
  Result<ViewBatch> get_or_compute(const Keyspace& keyspace,
                                   std::span<const CellIndex> cells,
                                   const ComputeViews& compute);

  ViewCacheCounters counters() const;

 private:
  std::shared_ptr<ViewStore> memory_;
  std::shared_ptr<ViewStore> disk_;
  std::shared_ptr<ViewStore> distorted_;
  SingleFlight<ViewKey, SharedView> flights_;
  std::atomic<std::uint64_t> cast_{0};
  std::atomic<std::uint64_t> waits_{0};
  std::atomic<std::uint64_t> failed_{0};
};

}  // namespace semview::cache
