// SPDX-License-Identifier: Apache-2.0
/// An observation, a matrix and some views to score. Inside the module only.
#pragma once

#include <cstddef>
#include <vector>

#include "semview/benchmark/subject.hpp"
#include "semview/core/result.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/observation.hpp"

namespace semview::benchmark::detail {

struct ScoringTask {
  Observation observation;  ///< all around, a tenth of its labels wrong
  similarity::WeightMatrix weights;
  similarity::PreparedObservation prepared;
  std::vector<ColumnView> views;
};

/// Weights are drawn from [-1, 1]; the observation is made from beside a cell, a little above the
/// map's eye height.
Result<ScoringTask> scoring_task(const Subject& subject,
                                 const PanoramaCamera& camera,
                                 std::size_t cells);

}  // namespace semview::benchmark::detail
