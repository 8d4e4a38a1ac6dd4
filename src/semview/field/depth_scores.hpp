// SPDX-License-Identifier: Apache-2.0
/// The likelihood of depth images in the numbers that all models answer with.
#pragma once

#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/field/field_likelihood.hpp"
#include "semview/view/score_source.hpp"

namespace semview::field {

/// Scores poses: a batch's similarity is the mean over pixels of the logarithm of equation (3), in
/// [-8, 0], to 1e-6. `observed_pixels` is 1, so that it is no sum. Particles weigh
/// exp(κ · similarity) with κ pixels' worth of it, `FieldModelConfig::effective_pixels`.
///
/// Every pose has a score, also where no robot can stand. There are no views: `origins` stay 0.
/// @errors kInvalidArgument: a pose is not finite, a distorted map.
/// @cost a compass is 120 poses
Result<ScoreBatch> score_depth(const FieldLikelihood& likelihood,
                               const FieldObservation& observation,
                               const ScoreRequest& request,
                               ThreadPool& pool);

/// What `score_depth` fills in: the scale, and room for all sums, which are `kNoView`.
ScoreBatch unscored_depth_batch(const ScoreRequest& request);

}  // namespace semview::field
