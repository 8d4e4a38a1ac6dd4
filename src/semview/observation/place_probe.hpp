// SPDX-License-Identifier: Apache-2.0
/// How well an observation fits where the robot is believed to be, and how well places all over the
/// map.
#pragma once

#include <cstddef>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/affine.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/view/score_source.hpp"

namespace semview::observation {

/// A probe is as much work as a compass batch of as many particles.
inline constexpr std::size_t kMostProbeCells = 2000;

/// Every fourth of some free cells along x and y: one place in 0.4 m. On floors where those are
/// more than `kMostProbeCells` every eighth, and so on; all cells if they are so few that none is
/// left.
std::vector<CellIndex> probe_cells(std::vector<CellIndex> free_cells);

/// Similarities of the current observation. Near is within 1 m.
struct PlaceScores {
  double here = 0.0;       ///< the best near the pose, at headings within 30° of its own; that of
                           ///< `mean` if nothing can be seen from there
  double elsewhere = 0.0;  ///< the best that is not near; that of `mean` if there is none
  double mean = 0.0;       ///< of the probe cells, each at its best heading
};

/// Compares the observation that `source` was given: with the cells near the pose, one in 0.2 m;
/// with the probe cells; and with the cells around the best of these that are not near.
/// @param map_from_eye  the pose in question
/// @param cells  not empty
/// @param affine  how the map is taken to be distorted
/// @errors those of `ScoreSource::score`; kInvalidArgument: a pose beyond the grid; kInternal: an
/// answer of another size than the question.
Result<PlaceScores> probe_place(ScoreSource& source,
                                const Pose2& map_from_eye,
                                const std::vector<CellIndex>& cells,
                                const MapAffine& affine);

}  // namespace semview::observation
