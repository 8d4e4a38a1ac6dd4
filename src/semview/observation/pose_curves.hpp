// SPDX-License-Identifier: Apache-2.0
/// The scores of all headings of many poses, each cell asked for once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/view/score_source.hpp"

namespace semview::observation {

/// A particle cloud that knows where it is stands in a few cells: 480 bytes travel for each of them
/// and not for each particle.
struct PoseCurves {
  /// As of a request with `whole_curve`, but with a curve for each distinct cell and distortion;
  /// `sums` and `best_heading` are one a pose.
  ScoreBatch batch;
  std::vector<std::size_t> cell_of_pose;

  /// 120 sums, in order of the headings of the PoseGrid.
  std::span<const std::int32_t> of_pose(std::size_t pose) const {
    return std::span(batch.curve)
        .subspan(cell_of_pose[pose] * PoseGrid::kHeadings, PoseGrid::kHeadings);
  }
};

/// The curves of `request`'s poses with its affines; its mode is the compass whatever it says.
/// @errors those of `ScoreSource::score`; kInvalidArgument: a pose beyond the grid; kInternal: an
/// answer of another size than the question.
Result<PoseCurves> score_curves(ScoreSource& source, const ScoreRequest& request);

}  // namespace semview::observation
