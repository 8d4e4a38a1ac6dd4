// SPDX-License-Identifier: Apache-2.0
/// Scores poses that each have their own idea of how the map is distorted.
#pragma once

#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "semview/view/score_source.hpp"
#include "semview/view/view_source.hpp"

namespace semview::similarity {

/// As `score_poses`, for a request with an affine a pose: poses of one affine (on the grid of
/// `kAffineStep`) are scored together.
/// @errors those of `score_poses`; kInvalidArgument: not one affine a pose;
/// `ViewSource::undistorted_views`.
Result<ScoreBatch> score_distorted(const PreparedObservation& observation,
                                   ViewSource& views,
                                   const ScoreRequest& request,
                                   ThreadPool& pool);

}  // namespace semview::similarity
