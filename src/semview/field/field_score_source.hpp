// SPDX-License-Identifier: Apache-2.0
/// The likelihood of depth images as a source of scores, for whatever asks one.
#pragma once

#include <memory>
#include <utility>

#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/field/field_likelihood.hpp"
#include "semview/view/score_source.hpp"

namespace semview::field {

/// Scores `Observation::voxels` as `score_depth` does.
class FieldScoreSource final : public ScoreSource {
 public:
  /// @param profile  of the views that the same robot would ask for; not looked at
  /// @param pool     must outlive the source
  FieldScoreSource(std::shared_ptr<const FieldLikelihood> likelihood,
                   const ViewProfile& profile,
                   ThreadPool& pool)
      : likelihood_(std::move(likelihood)), profile_(profile), pool_(pool) {}

  /// With an observation that the likelihood has prepared, which may be shared.
  FieldScoreSource(std::shared_ptr<const FieldLikelihood> likelihood,
                   std::shared_ptr<const FieldObservation> observation,
                   const ViewProfile& profile,
                   ThreadPool& pool)
      : FieldScoreSource(std::move(likelihood), profile, pool) {
    observation_ = std::move(observation);
  }

  const ViewProfile& profile() const override { return profile_; }

  /// @errors kInvalidArgument: an observation without voxels; those of `FieldLikelihood::prepare`.
  Status set_observation(const Observation& observation) override;

  /// @errors kFailedPrecondition: no observation set; those of `score_depth`.
  Result<ScoreBatch> score(const ScoreRequest& request) override;

 private:
  std::shared_ptr<const FieldLikelihood> likelihood_;
  ViewProfile profile_;
  ThreadPool& pool_;
  std::shared_ptr<const FieldObservation> observation_;
};

}  // namespace semview::field
