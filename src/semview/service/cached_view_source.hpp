// SPDX-License-Identifier: Apache-2.0
/// A view source behind the cache.
#pragma once

#include <memory>
#include <span>

#include "semview/cache/cache_key.hpp"
#include "semview/cache/view_cache.hpp"
#include "semview/view/view_source.hpp"

namespace semview::service {

/// Asks the cache first and its source for the rest. `origins` counts distinct cells.
class CachedViewSource final : public ViewSource {
 public:
  /// `source` must outlive this one; its views are those of `keyspace`.
  CachedViewSource(ViewSource& source,
                   cache::Keyspace keyspace,
                   std::shared_ptr<cache::ViewCache> cache)
      : source_(source), keyspace_(std::move(keyspace)), cache_(std::move(cache)) {}

  const ViewProfile& profile() const override { return source_.profile(); }
  /// @errors those of the source; kInternal: it threw
  Result<ViewBatch> views(std::span<const CellIndex> cells) override;
  Result<ViewBatch> undistorted_views(std::span<const CellIndex> cells,
                                      const MapAffine& affine) override;

 private:
  ViewSource& source_;
  cache::Keyspace keyspace_;
  std::shared_ptr<cache::ViewCache> cache_;
};

}  // namespace semview::service
