// SPDX-License-Identifier: Apache-2.0
/// First particles from everything that one observation says of the floor, the map's distortion
/// included.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "semview/core/random.hpp"
#include "semview/core/result.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/localization/affine_state.hpp"
#include "semview/localization/observation_model.hpp"
#include "semview/localization/particle_set.hpp"

namespace semview::localization {

/// How thoroughly is searched.
struct AnnealedStartConfig {
  std::size_t hypotheses = 30000;  ///< drawn evenly over the floor; >= `survivors`
  std::size_t survivors = 3000;    ///< of them that go on, and are moved in every round; >= 1
  /// To which power the likelihood is taken in the end, in (0, 1]. Below 1: one image of a map that
  /// is drawn with errors may fit another place better than the true one, which then keeps some
  /// particles for the next image to judge.
  double exponent = 1.0;
  /// Share of the effective sample size that a round may cost, in (0, 1): it sets how fast the
  /// likelihood is sharpened.
  double keep = 0.4;
  int most_rounds = 12;       ///< of sharpening; >= 1. The last one takes the whole power.
  int moves = 1;              ///< of each survivor in a round, >= 1
  double move_m = 0.15;       ///< σ of a move along x and y; > 0
  double move_affine = 0.05;  ///< and in ln a, ln b and k; >= 0
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const AnnealedStartConfig& config);

/// `count` > 0 particles of equal weight from the posterior (at `exponent` 1) of the observation
/// that `model` was given, over all free cells, headings and distortions. They have the observation
/// in them.
///
/// A sampler of growing exponents of the likelihood: hypotheses are drawn from the prior; in each
/// round their weights grow to the next exponent, they are resampled, and Metropolis-Hastings steps
/// move them under it, so that places that are few draws in the prior are as many as they deserve.
/// Headings are the model's best where the yaw is not known.
/// @source Del Moral, Doucet, Jasra 2006, "Sequential Monte Carlo samplers".
/// @param free_cells  not empty
/// @param affine  none: the map is as drawn
/// @errors those of `model`; kFailedPrecondition: no hypothesis is possible.
Result<ParticleSet> annealed_particles(ObservationModel& model,
                                       std::span<const CellIndex> free_cells,
                                       const std::optional<AffineStateConfig>& affine,
                                       const AnnealedStartConfig& config,
                                       std::size_t count,
                                       Rng& rng);

}  // namespace semview::localization
