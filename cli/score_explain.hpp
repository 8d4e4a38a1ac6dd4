// SPDX-License-Identifier: Apache-2.0
/// `semview score --explain`: what raised and what lowered a score.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "semview/similarity/score_explanation.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/score_source.hpp"
#include "semview/view/view_source.hpp"

namespace semview::cli {

/// What a score is made of.
struct ScoreParts {
  const Observation& observation;
  const similarity::WeightMatrix& weights;
  const ClassTable& map_classes;
};

/// Explains the one score of `batch`, at its best heading where it was scored with the compass, and
/// writes the picture.
/// @errors kFailedPrecondition: the pose has no view, or the views are not those of the score.
Result<similarity::ScoreExplanation> explain(const ScoreParts& parts,
                                             ViewSource& views,
                                             const Pose2& pose,
                                             const ScoreBatch& batch,
                                             const std::string& output);

/// Two tables: by observed class, and by pair with the map's class.
void print_explanation(const similarity::ScoreExplanation& explanation, const ScoreParts& parts);
nlohmann::ordered_json explanation_json(const similarity::ScoreExplanation& explanation,
                                        const ScoreParts& parts);

}  // namespace semview::cli
