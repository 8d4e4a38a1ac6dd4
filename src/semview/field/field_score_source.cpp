// SPDX-License-Identifier: Apache-2.0
#include "semview/field/field_score_source.hpp"

#include "semview/field/depth_scores.hpp"

namespace semview::field {

Status FieldScoreSource::set_observation(const Observation& observation) {
  observation_.reset();
  if (!observation.voxels) {
    return fail(ErrorCode::kInvalidArgument, "the observation has no depth");
  }
  SEMVIEW_TRY(observation_, likelihood_->prepare(*observation.voxels, pool_));
  return {};
}

Result<ScoreBatch> FieldScoreSource::score(const ScoreRequest& request) {
  if (!observation_) return fail(ErrorCode::kFailedPrecondition, "no observation set");
  return score_depth(*likelihood_, *observation_, request, pool_);
}

}  // namespace semview::field
