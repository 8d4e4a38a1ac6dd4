// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/engine_view_source.hpp"

#include <utility>

namespace semview::raycast {

Result<std::unique_ptr<EngineViewSource>> EngineViewSource::create(
    std::shared_ptr<const Engine> engine,
    const ViewProfile& profile,
    double ground_height_m,
    ThreadPool& pool) {
  SEMVIEW_TRY_STATUS(validate(profile));
  return std::unique_ptr<EngineViewSource>(
      new EngineViewSource(std::move(engine), profile, ground_height_m, pool));
}

EngineViewSource::EngineViewSource(std::shared_ptr<const Engine> engine,
                                   const ViewProfile& profile,
                                   double ground_height_m,
                                   ThreadPool& pool)
    : engine_(std::move(engine)),
      profile_(profile),
      eye_z_m_(ground_height_m + profile.eye_height_m),
      pool_(&pool) {}

Result<ViewBatch> EngineViewSource::views(std::span<const CellIndex> cells) {
  return undistorted_views(cells, {});
}

Result<ViewBatch> EngineViewSource::undistorted_views(std::span<const CellIndex> cells,
                                                      const MapAffine& affine) {
  SEMVIEW_TRY_STATUS(validate(affine));
  ViewBatch batch;
  batch.views.resize(cells.size());
  // Even a view by columns takes 20 us: one cell a task balances best.
  pool_->parallel_for(cells.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PanoramaRequest request{PoseGrid::center(cells[i]), eye_z_m_, profile_.camera, affine};
      batch.views[i] =
          std::make_shared<const ColumnView>(engine_->column_view(request, profile_.ranges));
    }
  });
  batch.origins.cast = cells.size();
  return batch;
}

}  // namespace semview::raycast
