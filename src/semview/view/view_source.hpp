// SPDX-License-Identifier: Apache-2.0
/// The seam between whoever needs views and whoever has them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/affine.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/view/column_view.hpp"
#include "semview/view/view_profile.hpp"

namespace semview {

/// Where the cells of an answer came from.
struct ViewOrigins {
  std::uint64_t memory = 0;
  std::uint64_t disk = 0;
  std::uint64_t cast = 0;

  ViewOrigins& operator+=(const ViewOrigins& other) {
    memory += other.memory;
    disk += other.disk;
    cast += other.cast;
    return *this;
  }
  std::uint64_t total() const { return memory + disk + cast; }
  bool operator==(const ViewOrigins&) const = default;
};

/// One view a requested cell, in the order of the request; null where the cell has no view.
struct ViewBatch {
  std::vector<SharedView> views;
  ViewOrigins origins;
};

/// Gives the views of cells, cast from their centres at yaw 0.
///
/// A source returns the same views for the same cells always. Cells may repeat; a source need not
/// deduplicate.
/// @threads `views` may be called from several threads at once.
class ViewSource {
 public:
  virtual ~ViewSource() = default;
  virtual const ViewProfile& profile() const = 0;
  virtual Result<ViewBatch> views(std::span<const CellIndex> cells) = 0;

  /// The views of a plan that is drawn distorted, as they would be in the true world: from the same
  /// cells of the drawn plan, with `affine` the way from true to drawn metres.
  /// @errors kUnimplemented: this source has only the map as it is drawn.
  virtual Result<ViewBatch> undistorted_views(std::span<const CellIndex> cells,
                                              const MapAffine& affine) {
    if (affine.is_identity()) return views(cells);
    return fail(ErrorCode::kUnimplemented, "this source of views knows no distorted maps");
  }
};

}  // namespace semview
