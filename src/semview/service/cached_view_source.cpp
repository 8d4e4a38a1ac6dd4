// SPDX-License-Identifier: Apache-2.0
#include "semview/service/cached_view_source.hpp"

#include <vector>

namespace semview::service {

Result<ViewBatch> CachedViewSource::views(std::span<const CellIndex> cells) {
  return undistorted_views(cells, {});
}

Result<ViewBatch> CachedViewSource::undistorted_views(std::span<const CellIndex> cells,
                                                      const MapAffine& affine) {
  cache::Keyspace keyspace = keyspace_;
  keyspace.affine = affine;
  return cache_->get_or_compute(
      keyspace, cells, [&](std::span<const CellIndex> missing) -> Result<std::vector<SharedView>> {
        SEMVIEW_TRY(ViewBatch batch, source_.undistorted_views(missing, affine));
        return std::move(batch.views);
      });
}

}  // namespace semview::service
