// SPDX-License-Identifier: Apache-2.0
/// Any ScoreSource as the particle filter's observation model.
#pragma once

#include "semview/localization/heading_strategy.hpp"
#include "semview/localization/observation_model.hpp"
#include "semview/observation/combined_heading.hpp"
#include "semview/observation/similarity_weighting.hpp"
#include "semview/view/observation.hpp"
#include "semview/view/score_source.hpp"

namespace semview::observation {

/// What the scores of a batch looked like.
struct ScoreSummary {
  double best_similarity = 0.0;  ///< over poses with a view; 0 if none has one
  double mean_similarity = 0.0;
  std::size_t without_view = 0;  ///< poses that have none
  ViewOrigins origins;
};

/// Weighs poses by their similarity. A pose without a view gets the lowest weight of the batch that
/// is not zero: nothing speaks against it but that nobody can look from there. If no pose has a
/// view, every log weight is NaN: the batch says nothing.
class ScoreSourceObservationModel final : public localization::ObservationModel {
 public:
  /// `source` must outlive the model; the configurations must be valid.
  ScoreSourceObservationModel(ScoreSource& source,
                              localization::HeadingStrategy strategy,
                              const SimilarityWeightingConfig& config,
                              const CombinedHeadingConfig& combined = {})
      : source_(source), strategy_(strategy), config_(config), combined_(combined) {}

  /// What the next poses are weighed against. @errors those of `ScoreSource::set_observation`
  Status set_observation(const Observation& observation);

  /// Scores where the robot's eye would stand. A compass finds the heading there; the eye itself is
  /// placed by the pose's own yaw, which for a robot's few centimetres is near enough.
  /// @errors those of `ScoreSource::score`; kInternal: an answer of another size than the question.
  Result<localization::ObservationWeights> weigh(
      std::span<const localization::Particle> particles) override;

  /// Of the last `weigh` that gave weights.
  const ScoreSummary& last_scores() const { return last_scores_; }

 private:
  ScoreRequest question(std::span<const localization::Particle> particles) const;

  ScoreSource& source_;
  localization::HeadingStrategy strategy_;
  SimilarityWeightingConfig config_;
  CombinedHeadingConfig combined_;
  Pose2 base_from_eye_;
  ScoreSummary last_scores_;
};

}  // namespace semview::observation
