// SPDX-License-Identifier: Apache-2.0
/// Scores a batch of poses against one prepared observation.
#pragma once

#include <cstddef>

#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/similarity/pose_groups.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "semview/view/score_source.hpp"
#include "semview/view/view_source.hpp"

namespace semview::similarity {

/// Poses are first merged by cell, so that each view is asked for and compared once, however many
/// poses share it (the paper's E-cache). A pose without a view has the sum `kNoView`, its own grid
/// heading as the best one, and `kNoView` all along its curve.
///
/// The result does not depend on the number of threads.
/// @errors kInvalidArgument: a pose that is not finite or beyond the grid, or `whole_curve` without
/// the compass; kInternal: the source gave views of another shape or map; what `views` fails with.
Result<ScoreBatch> score_poses(const PreparedObservation& observation,
                               ViewSource& views,
                               const ScoreRequest& request,
                               ThreadPool& pool);

// The same in parts, for whoever cuts the work by himself.

/// A batch with room for every score of the request.
/// @errors kInvalidArgument: `whole_curve` without the compass.
Result<ScoreBatch> unscored_batch(const PreparedObservation& observation,
                                  const ScoreRequest& request);

/// Cells [begin, end) of a PoseGroups.
struct CellRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Scores the poses of some cells into their places of `batch`, all but its origins.
///
/// @param groups  The poses of `request`.
/// @return where the views of these cells came from
/// @threads For ranges that have no cell in common at once.
/// @errors those of `score_poses` that views may have.
Result<ViewOrigins> score_cells(const PreparedObservation& observation,
                                ViewSource& views,
                                const ScoreRequest& request,
                                const PoseGroups& groups,
                                CellRange range,
                                ThreadPool& pool,
                                ScoreBatch& batch);

}  // namespace semview::similarity
