// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/score_explanation.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <tuple>
#include <utility>

#include "semview/similarity/integer_weights.hpp"
#include "semview/similarity/prepared_observation.hpp"

namespace semview::similarity {
namespace {

void sort_by_size(std::vector<ClassContribution>& contributions) {
  std::ranges::sort(contributions, {}, [](const ClassContribution& c) {
    return std::tuple(-std::abs(c.sum), c.observed, c.map);
  });
}

}  // namespace

Result<ScoreExplanation> explain_score(const Observation& observation,
                                       const WeightMatrix& weights,
                                       const ClassTable& map_classes,
                                       const PanoramaCamera& camera,
                                       const ColumnView& view,
                                       int heading) {
  SEMVIEW_TRY(const PreparedObservation prepared,
              PreparedObservation::build(observation, weights, map_classes, camera));
  if (!prepared.fits(view)) {
    return fail(ErrorCode::kInternal, "the view does not fit the observation's camera and map");
  }
  SEMVIEW_TRY(
      const IntegerWeights integers,
      integer_weights(weights, prepared.weight_scale(), observation.classes, map_classes, camera));
  ScoreExplanation explanation;
  explanation.weight_scale = prepared.weight_scale();
  explanation.observed_pixels = prepared.observed_pixels();
  explanation.view = view.to_labels(heading);
  explanation.contributions = Image<std::int32_t>(camera.rows, camera.columns);
  std::map<std::pair<ClassId, ClassId>, ClassContribution> pairs;
  std::map<ClassId, ClassContribution> observed;
  for (int r = 0; r < camera.rows; ++r) {
    for (int c = 0; c < camera.columns; ++c) {
      const ClassId label = observation.labels.at(r, c);
      if (!is_scored(label)) continue;
      const ClassId seen = explanation.view.at(r, c);
      const std::int32_t part = integers.at(r, label, seen);
      explanation.contributions.at(r, c) = part;
      explanation.sum += part;
      for (ClassContribution* sum : {&pairs[{label, seen}], &observed[label]}) {
        ++sum->pixels;
        sum->sum += part;
      }
    }
  }
  for (auto& [key, pair] : pairs) {
    std::tie(pair.observed, pair.map) = key;
    explanation.pairs.push_back(pair);
  }
  for (auto& [label, all] : observed) {
    all.observed = label;
    explanation.observed.push_back(all);
  }
  sort_by_size(explanation.pairs);
  sort_by_size(explanation.observed);
  return explanation;
}

}  // namespace semview::similarity
