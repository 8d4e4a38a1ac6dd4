// SPDX-License-Identifier: Apache-2.0
/// Views of the map and depth together: one observation judged by both.
#pragma once

#include <memory>
#include <utility>

#include "semview/core/result.hpp"
#include "semview/view/score_source.hpp"

namespace semview::observation {

/// What a similarity of each is worth as a logarithm of a likelihood.
struct MixedConfig {
  double views_kappa = 60.0;        ///< κ of `WeightTransform::kExponential`, in (0, 1000]
  double effective_pixels = 300.0;  ///< of the depth image, in (0, 2000]; see `FieldModelConfig`
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const MixedConfig& config);

/// The sum of the logarithms of two likelihoods, as if views and depth were independent: a batch's
/// similarity is κ · (views) + (effective pixels) · (depth), to 1e-5, and `observed_pixels` is 1.
/// Particles weigh exp(similarity).
///
/// Poses are those of the views' eye, as everywhere. Where there is no view there is no score.
/// Both sources may be of this process or remote.
class MixedScoreSource final : public ScoreSource {
 public:
  /// @param config  valid
  MixedScoreSource(std::unique_ptr<ScoreSource> views,
                   std::unique_ptr<ScoreSource> depth,
                   const MixedConfig& config)
      : views_(std::move(views)), depth_(std::move(depth)), config_(config) {}

  const ViewProfile& profile() const override { return views_->profile(); }

  /// @errors those of both sources
  Status set_observation(const Observation& observation) override;

  /// @errors those of both sources
  /// @cost A compass is 120 poses of the depth and a curve of the views.
  Result<ScoreBatch> score(const ScoreRequest& request) override;

 private:
  Result<ScoreBatch> depth_of(const ScoreRequest& request);

  std::unique_ptr<ScoreSource> views_;
  std::unique_ptr<ScoreSource> depth_;
  MixedConfig config_;
  Pose2 eye_from_base_;
};

}  // namespace semview::observation
