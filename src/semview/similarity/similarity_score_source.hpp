// SPDX-License-Identifier: Apache-2.0
/// The 2017 paper's comparison as a ScoreSource over any ViewSource.
#pragma once

#include <optional>

#include "semview/core/thread_pool.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/score_source.hpp"
#include "semview/view/view_source.hpp"

namespace semview::similarity {

class SimilarityScoreSource final : public ScoreSource {
 public:
  /// `views` and `pool` must outlive the source; `map_classes` are those of the views.
  SimilarityScoreSource(ViewSource& views,
                        ClassTable map_classes,
                        WeightMatrix weights,
                        ThreadPool& pool);

  const ViewProfile& profile() const override { return views_.profile(); }
  Status set_observation(const Observation& observation) override;
  Result<ScoreBatch> score(const ScoreRequest& request) override;

 private:
  ViewSource& views_;
  ClassTable map_classes_;
  WeightMatrix weights_;
  ThreadPool& pool_;
  std::optional<PreparedObservation> observation_;
};

}  // namespace semview::similarity
