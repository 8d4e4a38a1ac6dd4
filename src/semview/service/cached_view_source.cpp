// SPDX-License-Identifier: Apache-2.0
#include "semview/service/cached_view_source.hpp"

#include <vector>

namespace semview::service {

Result<ViewBatch> CachedViewSource::views(std::span<const CellIndex> cells) {
  return cache_->get_or_compute(
      keyspace_,
      cells,
      [this](std::span<const CellIndex> missing) -> Result<std::vector<SharedView>> {
        SEMVIEW_TRY(ViewBatch batch, source_.views(missing));
        return std::move(batch.views);
      });
}

}  // namespace semview::service
