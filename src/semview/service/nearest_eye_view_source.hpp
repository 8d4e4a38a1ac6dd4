// SPDX-License-Identifier: Apache-2.0
/// The rule for cells whose eye is in a wall: above every engine and cache.
#pragma once

#include <span>
#include <vector>

#include "semview/view/view_source.hpp"

namespace semview::map {
class CellGrid;
}

namespace semview::service {

/// Gives a cell without an eye the view of the nearest cell that has one, null if there is none
/// near enough (docs/conventions.md#view-of-a-cell). Asks its source for each distinct view cell
/// once.
class NearestEyeViewSource final : public ViewSource {
 public:
  /// Both must outlive the source.
  NearestEyeViewSource(ViewSource& source, const map::CellGrid& cells)
      : source_(source), cells_(cells) {}

  const ViewProfile& profile() const override { return source_.profile(); }
  /// @errors those of the source
  Result<ViewBatch> views(std::span<const CellIndex> cells) override;
  Result<ViewBatch> undistorted_views(std::span<const CellIndex> cells,
                                      const MapAffine& affine) override;

 private:
  ViewSource& source_;
  const map::CellGrid& cells_;
};

/// The distinct cells whose views stand for those of `cells`, row by row.
std::vector<CellIndex> view_cells(const map::CellGrid& grid, std::span<const CellIndex> cells);

}  // namespace semview::service
