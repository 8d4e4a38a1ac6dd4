// SPDX-License-Identifier: Apache-2.0
/// What an observation says of the cells around a pose, and of the pose between them.
#pragma once

#include <optional>

#include "semview/core/result.hpp"
#include "semview/geometry/affine.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/view/score_source.hpp"

namespace semview::observation {

/// All headings of the 5 × 5 cells around a pose.
struct NearbyScores {
  Pose2 around;      ///< the pose
  ScoreBatch batch;  ///< with curves; cells row by row from the lowest, each from the left
};

/// Compares the observation that `source` was given.
/// @errors those of `ScoreSource::score`; kInvalidArgument: a pose beyond the grid; kInternal: an
/// answer of another size than the question.
Result<NearbyScores> score_nearby(ScoreSource& source,
                                  const Pose2& map_from_eye,
                                  const MapAffine& affine);

/// The highest of them at headings within 6° of the pose's; none if no cell has a view.
std::optional<double> best_similarity(const NearbyScores& nearby);

/// The pose between cells and headings where the similarity is highest.
///
/// In each cell a parabola through the three headings around the best one near the pose's; over the
/// cells the paraboloid of least squares through those tops; the heading is that of the cell
/// nearest to its top. None if a cell has no view, if the paraboloid has no top, or if that is more
/// than 0.15 m from the pose: then the observation does not say more than the cells do.
std::optional<Pose2> refined_pose(const NearbyScores& nearby);

}  // namespace semview::observation
