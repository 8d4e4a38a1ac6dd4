// SPDX-License-Identifier: Apache-2.0
/// The similarity of an observation over a whole floor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/geometry/image.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "semview/view/score_source.hpp"
#include "semview/view/view_source.hpp"

namespace semview::similarity {

/// The largest number of pixels of a heat map: a square kilometre of cells.
inline constexpr std::int64_t kMaxHeatMapPixels = 100'000'000;

/// What the headings of a cell weigh together, as a logarithm, from the similarity of each.
using CellWeight = std::function<double(std::span<const double, PoseGrid::kHeadings>)>;

/// Best of `headings` headings for each cell, on the cells' bounding box.
struct HeatMap {
  CellIndex origin;                  ///< the cell of pixel (row 0, column 0)
  Image<float> similarity;           ///< row 0 = lowest y; NaN: not asked for, or no view
  Image<std::uint8_t> best_heading;  ///< of the PoseGrid; ties: the lowest; 255 where NaN
  Image<double> log_weight;          ///< of all 120 headings; empty without a `CellWeight`
  ViewOrigins origins;

  /// The cell with the highest similarity (ties: the first row by row), and its heading.
  /// Without any view: the origin at heading 0.
  GridKey best() const { return highest(similarity); }
  /// The same of other values of these cells.
  GridKey highest(const Image<float>& values) const;
};

/// @param cells  May repeat.
/// @param headings  How many of the 120 headings are tried, evenly spaced from 0: a divisor of 120.
/// @param progress  Called now and then from the calling thread with (cells done, cells); may be
///        empty. Returning false ends the work with kCancelled.
/// @param cell_weight  Called from several threads; empty: no `HeatMap::log_weight`.
/// @errors kInvalidArgument: no cells, `headings` not a divisor of 120, or cells further apart than
/// `kMaxHeatMapPixels` allow; kCancelled; kInternal as for `score_poses`; what `views` fails with.
Result<HeatMap> heat_map(const PreparedObservation& observation,
                         ViewSource& views,
                         std::span<const CellIndex> cells,
                         int headings,
                         ThreadPool& pool,
                         const std::function<bool(std::size_t, std::size_t)>& progress = {},
                         const CellWeight& cell_weight = {});

/// The same of whatever `source` compares, an observation that it has been given; slower for views.
/// @param headings  Of the PoseGrid, increasing. With a `cell_weight` all 120 are asked for.
/// @errors as above, also where there are no headings, or not such; what `source` fails with.
Result<HeatMap> heat_map(ScoreSource& source,
                         std::span<const CellIndex> cells,
                         std::span<const int> headings,
                         const std::function<bool(std::size_t, std::size_t)>& progress = {},
                         const CellWeight& cell_weight = {});

/// The headings of the PoseGrid nearest to `count` evenly spaced ones from 0; halves go up.
/// @param count  1 to 120
std::vector<int> even_headings(int count);

}  // namespace semview::similarity
