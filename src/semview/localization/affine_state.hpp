// SPDX-License-Identifier: Apache-2.0
/// How distorted the map is, as a part of what particles believe.
#pragma once

#include "semview/core/random.hpp"
#include "semview/core/result.hpp"
#include "semview/geometry/affine.hpp"
#include "semview/localization/particle_set.hpp"

namespace semview::localization {

/// What is thought of a map before anything was seen: with `identity_share` it is exact, else its
/// axes are scaled by factors with normal logarithms and it is sheared by a normal factor.
struct AffineStateConfig {
  double identity_share = 0.2;    ///< in [0, 1]
  double log_scale_sigma = 0.22;  ///< of each axis, >= 0
  double shear_sigma = 0.18;      ///< >= 0
  /// How much of the spread resampling replaces by fresh noise, in [0, 1]: 0 keeps the first draws.
  /// @source Liu, West 2001, kernel smoothing: mean and variance stay.
  double renewal = 0.3;
  /// Least σ of that noise, so that the estimate can still move; >= 0.
  double least_sigma = 0.003;
  /// A drawing that is distorted otherwise in each place: ln a, ln b and k walk at random with this
  /// σ for the square root of each metre of the way, >= 0. 0: one distortion for the whole map.
  double drift = 0.0;
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const AffineStateConfig& config);

/// Gives each particle a distortion drawn from the prior.
void spread_affines(ParticleSet& particles, const AffineStateConfig& config, Rng& rng);

/// A distortion moved at random by σ in ln a, ln b and k; an exact one stays exact.
MapAffine moved(const MapAffine& affine, double sigma, Rng& rng);

/// Logarithm of the prior's density in ln a, ln b and k, up to a constant; the same for all that
/// are exact.
double log_prior(const MapAffine& affine, const AffineStateConfig& config);

/// Moves the distortions of particles that are not exact a little, as after each resampling.
void renew_affines(ParticleSet& particles, const AffineStateConfig& config, Rng& rng);

/// Lets the distortions of particles that are not exact walk by `config.drift`, after a way of
/// `way_m` true metres.
void walk_affines(ParticleSet& particles, const AffineStateConfig& config, double way_m, Rng& rng);

/// Mean and spread of the particles' distortions, scales by their logarithms.
struct AffineEstimate {
  MapAffine mean;
  double a_sigma = 0.0;
  double b_sigma = 0.0;
  double k_sigma = 0.0;
};
AffineEstimate estimate_affine(const ParticleSet& particles);

}  // namespace semview::localization
