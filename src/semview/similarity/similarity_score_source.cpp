// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/similarity_score_source.hpp"

#include <utility>

#include "semview/similarity/score_distorted.hpp"
#include "semview/similarity/score_poses.hpp"

namespace semview::similarity {

SimilarityScoreSource::SimilarityScoreSource(ViewSource& views,
                                             ClassTable map_classes,
                                             WeightMatrix weights,
                                             ThreadPool& pool)
    : views_(views),
      map_classes_(std::move(map_classes)),
      weights_(std::move(weights)),
      pool_(pool) {}

Status SimilarityScoreSource::set_observation(const Observation& observation) {
  SEMVIEW_TRY(
      observation_,
      PreparedObservation::build(observation, weights_, map_classes_, views_.profile().camera));
  return {};
}

Result<ScoreBatch> SimilarityScoreSource::score(const ScoreRequest& request) {
  if (!observation_) {
    return fail(ErrorCode::kFailedPrecondition, "score: no observation has been set");
  }
  if (request.affines.empty()) return score_poses(*observation_, views_, request, pool_);
  return score_distorted(*observation_, views_, request, pool_);
}

}  // namespace semview::similarity
