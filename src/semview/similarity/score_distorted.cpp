// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/score_distorted.hpp"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "semview/similarity/affine_groups.hpp"
#include "semview/similarity/score_poses.hpp"

namespace semview::similarity {

Result<ScoreBatch> score_distorted(const PreparedObservation& observation,
                                   ViewSource& views,
                                   const ScoreRequest& request,
                                   ThreadPool& pool) {
  SEMVIEW_TRY(const std::vector<AffineGroup> groups, group_by_affine(request));
  std::vector<std::optional<Result<ScoreBatch>>> answers(groups.size());
  pool.parallel_for(groups.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      UndistortedViews undistorted(views, groups[g].affine);
      answers[g] = score_poses(observation, undistorted, groups[g].request, pool);
    }
  });
  SEMVIEW_TRY(ScoreBatch batch, unscored_batch(observation, request));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    SEMVIEW_TRY(const ScoreBatch part, *std::move(answers[g]));
    put_scores(part, groups[g], batch);
  }
  return batch;
}

}  // namespace semview::similarity
