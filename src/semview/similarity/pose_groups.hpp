// SPDX-License-Identifier: Apache-2.0
/// Poses in order of the cells whose views they are compared with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/view/score_source.hpp"

namespace semview::similarity {

/// The poses of a request, each cell's together: cell i has those at `order[begins[i]]` to, but
/// without, `order[begins[i + 1]]`.
struct PoseGroups {
  std::vector<CellIndex> cells;        ///< distinct, row by row
  std::vector<std::uint32_t> begins;   ///< one a cell, and one more
  std::vector<std::uint32_t> order;    ///< indices of poses: by cell, then by heading if there are
                                       ///< headings, then as in the request
  std::vector<std::uint8_t> headings;  ///< one a pose; none with the compass, which needs none

  std::span<const std::uint32_t> poses_of(std::size_t cell) const {
    return std::span(order).subspan(begins[cell], begins[cell + 1] - begins[cell]);
  }
};

/// The cell whose view stands for that of a cell. Cells without a view stay as they are.
using ViewCell = std::function<CellIndex(const CellIndex&)>;

/// @param view_cell  May be empty: each cell stands for itself.
/// @errors kInvalidArgument, field `poses`: a pose that is not finite or beyond the grid.
/// @cost linear in the poses, about 10 ns each and what `view_cell` takes.
Result<PoseGroups> group_by_cell(std::span<const Pose2> poses,
                                 HeadingMode mode,
                                 const ViewCell& view_cell = {});

}  // namespace semview::similarity
