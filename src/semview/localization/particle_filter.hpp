// SPDX-License-Identifier: Apache-2.0
/// Monte Carlo localization: predict by odometry, weigh by an observation, resample when needed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "semview/core/result.hpp"
#include "semview/localization/affine_state.hpp"
#include "semview/localization/heading_strategy.hpp"
#include "semview/localization/kld_sampling.hpp"
#include "semview/localization/motion_model.hpp"
#include "semview/localization/observation_model.hpp"
#include "semview/localization/particle_set.hpp"

namespace semview::localization {

struct ParticleFilterConfig {
  /// Resample when N_eff falls below this share of the particles, in [0, 1]: 1 resamples after
  /// every observation as the 2017 paper does, 0 never.
  double resample_threshold = 0.5;
  CompassConfig compass = {};
  /// Set: resampling draws as many particles as the belief needs, and happens too when it needs
  /// less than half or more than twice of those there are.
  std::optional<KldConfig> kld = {};
  /// Set: particles carry distortions of the map, which resampling renews. The owner gives the
  /// first particles theirs (`spread_affines`).
  std::optional<AffineStateConfig> affine = {};
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const ParticleFilterConfig& config);

/// What one observation did.
struct UpdateReport {
  WeightOutcome outcome = WeightOutcome::kUsed;
  double effective_sample_size = 0.0;  ///< after weighing, before resampling
  /// Of the twentieth roots of the likelihoods, by the weights before: what a RecoveryMonitor
  /// follows. 0 if no particle is possible.
  double mean_likelihood = 0.0;
};

/// The filter. Its numbers follow from particles, inputs and seed alone: it uses no clock and no
/// thread. Each step draws from streams of its own, so that a step that was left out (a lost
/// observation) changes nothing in what the later ones draw. @threads for one thread at a time
class ParticleFilter {
 public:
  /// `config` must be valid; `particles` not empty, with weights that sum to 1.
  ParticleFilter(const ParticleFilterConfig& config,
                 std::shared_ptr<const MotionModel> motion,
                 ParticleSet particles,
                 std::uint64_t seed);

  const ParticleSet& particles() const { return particles_; }

  /// Goes on from another belief; `particles` as in the constructor.
  void restart(ParticleSet particles);

  /// Moves every particle by what odometry measured since the last call.
  void predict(const Pose2& before_from_after);

  /// Weighs every particle. @errors those of `model`; the particles are then as before.
  Result<UpdateReport> update(ObservationModel& model);

  /// Draws equal-weight particles by weight if the effective sample size asks for it. Apart from
  /// `update`, so that estimates can be taken from the weighted particles.
  /// @return whether it did
  bool resample_if_needed();

  /// Puts `newcomers` in the place of as many particles, which resampling chooses; all weigh the
  /// same then. Fewer than there are particles; none: nothing happens.
  void replace_some(ParticleSet newcomers);

 private:
  ParticleSet draw(std::size_t count);

  ParticleFilterConfig config_;
  std::shared_ptr<const MotionModel> motion_;
  ParticleSet particles_;
  std::uint64_t seed_;
  std::uint64_t predictions_ = 0;
};

}  // namespace semview::localization
