// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/embree_view_source.hpp"

#include <utility>

#include "semview/raycast/panorama_renderer.hpp"

namespace semview::raycast {

Result<std::unique_ptr<EmbreeViewSource>> EmbreeViewSource::create(
    std::shared_ptr<const Scene> scene,
    const ViewProfile& profile,
    double ground_height_m,
    ThreadPool& pool) {
  SEMVIEW_TRY_STATUS(validate(profile));
  return std::unique_ptr<EmbreeViewSource>(
      new EmbreeViewSource(std::move(scene), profile, ground_height_m, pool));
}

EmbreeViewSource::EmbreeViewSource(std::shared_ptr<const Scene> scene,
                                   const ViewProfile& profile,
                                   double ground_height_m,
                                   ThreadPool& pool)
    : scene_(std::move(scene)),
      profile_(profile),
      eye_z_m_(ground_height_m + profile.eye_height_m),
      pool_(&pool) {}

Result<ViewBatch> EmbreeViewSource::views(std::span<const CellIndex> cells) {
  ViewBatch batch;
  batch.views.resize(cells.size());
  // A panorama takes about a millisecond: one cell a task balances best and costs nothing.
  pool_->parallel_for(cells.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PanoramaRequest request{PoseGrid::center(cells[i]), eye_z_m_, profile_.camera, {}};
      batch.views[i] = std::make_shared<const ColumnView>(render_column_view(*scene_, request));
    }
  });
  batch.origins.cast = cells.size();
  return batch;
}

}  // namespace semview::raycast
