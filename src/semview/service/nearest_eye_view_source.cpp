// SPDX-License-Identifier: Apache-2.0
#include "semview/service/nearest_eye_view_source.hpp"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <vector>

#include "semview/map/cell_grid.hpp"

namespace semview::service {

Result<ViewBatch> NearestEyeViewSource::views(std::span<const CellIndex> cells) {
  return undistorted_views(cells, {});
}

Result<ViewBatch> NearestEyeViewSource::undistorted_views(std::span<const CellIndex> cells,
                                                          const MapAffine& affine) {
  std::vector<CellIndex> distinct;
  std::unordered_map<CellIndex, std::size_t> index;
  std::vector<std::optional<std::size_t>> view_of(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::optional<CellIndex> cell = cells_.view_cell(cells[i]);
    if (!cell) continue;
    const auto [entry, is_new] = index.try_emplace(*cell, distinct.size());
    if (is_new) distinct.push_back(*cell);
    view_of[i] = entry->second;
  }
  SEMVIEW_TRY(const ViewBatch found, source_.undistorted_views(distinct, affine));
  ViewBatch batch;
  batch.origins = found.origins;
  batch.views.resize(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (view_of[i]) batch.views[i] = found.views[*view_of[i]];
  }
  return batch;
}

std::vector<CellIndex> view_cells(const map::CellGrid& grid, std::span<const CellIndex> cells) {
  std::vector<CellIndex> views;
  views.reserve(cells.size());
  for (const CellIndex& cell : cells) {
    if (const auto view = grid.view_cell(cell)) views.push_back(*view);
  }
  std::ranges::sort(views);
  const auto repeated = std::ranges::unique(views);
  views.erase(repeated.begin(), repeated.end());
  return views;
}

}  // namespace semview::service
