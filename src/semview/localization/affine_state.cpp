// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/affine_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace semview::localization {
namespace {

/// ln a, ln b, k: the coordinates in which distortions are averaged.
using Coordinates = std::array<double, 3>;

Coordinates coordinates(const MapAffine& affine) {
  return {std::log(affine.a), std::log(affine.b), affine.k};
}

MapAffine affine_of(const Coordinates& at) {
  const auto scale = [](double log_scale) { return std::clamp(std::exp(log_scale), 0.2, 5.0); };
  return {scale(at[0]), scale(at[1]), std::clamp(at[2], -2.0, 2.0)};
}

struct Spread {
  Coordinates mean{};
  Coordinates sigma{};
};

/// By weight, of those particles that `included` takes.
template <typename Included>
Spread spread_of(const ParticleSet& particles, const Included& included) {
  Spread spread;
  double total = 0.0;
  for (const Particle& particle : particles) {
    if (!included(particle)) continue;
    total += particle.weight;
    const Coordinates at = coordinates(particle.affine);
    for (std::size_t i = 0; i < at.size(); ++i) spread.mean[i] += particle.weight * at[i];
  }
  if (!(total > 0.0)) return {};
  for (double& mean : spread.mean) mean /= total;
  for (const Particle& particle : particles) {
    if (!included(particle)) continue;
    const Coordinates at = coordinates(particle.affine);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double off = at[i] - spread.mean[i];
      spread.sigma[i] += particle.weight * off * off;
    }
  }
  for (double& sigma : spread.sigma) sigma = std::sqrt(sigma / total);
  return spread;
}

}  // namespace

Status validate(const AffineStateConfig& config) {
  // The field's name goes beside the message: command lines have another.
  const auto refuse = [](const char* field, double value, const char* range) {
    return fail(
        Error{ErrorCode::kInvalidArgument, fmt::format("{}: expected {}", value, range), field});
  };
  const auto share = [&](const char* field, double value) -> Status {
    if (value >= 0.0 && value <= 1.0) return {};
    return refuse(field, value, "a share from 0 to 1");
  };
  const auto sigma = [&](const char* field, double value) -> Status {
    if (value >= 0.0 && value <= 10.0) return {};  // e^10: no drawing is that wrong
    return refuse(field, value, "a finite number from 0 to 10");
  };
  SEMVIEW_TRY_STATUS(share("identity_share", config.identity_share));
  SEMVIEW_TRY_STATUS(sigma("log_scale_sigma", config.log_scale_sigma));
  SEMVIEW_TRY_STATUS(sigma("shear_sigma", config.shear_sigma));
  SEMVIEW_TRY_STATUS(share("renewal", config.renewal));
  SEMVIEW_TRY_STATUS(sigma("least_sigma", config.least_sigma));
  return sigma("drift", config.drift);
}

void spread_affines(ParticleSet& particles, const AffineStateConfig& config, Rng& rng) {
  for (Particle& particle : particles) {
    const bool exact = rng.uniform() < config.identity_share;
    const Coordinates drawn{rng.normal(0.0, config.log_scale_sigma),
                            rng.normal(0.0, config.log_scale_sigma),
                            rng.normal(0.0, config.shear_sigma)};
    particle.affine = exact ? MapAffine{} : affine_of(drawn);
  }
}

MapAffine moved(const MapAffine& affine, double sigma, Rng& rng) {
  if (affine.is_identity()) return affine;
  Coordinates at = coordinates(affine);
  for (double& coordinate : at) coordinate += rng.normal(0.0, sigma);
  return affine_of(at);
}

double log_prior(const MapAffine& affine, const AffineStateConfig& config) {
  if (affine.is_identity()) return 0.0;
  const Coordinates at = coordinates(affine);
  const Coordinates sigma{config.log_scale_sigma, config.log_scale_sigma, config.shear_sigma};
  double log_density = 0.0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (sigma[i] > 0.0) log_density -= 0.5 * (at[i] / sigma[i]) * (at[i] / sigma[i]);
  }
  return log_density;
}

void renew_affines(ParticleSet& particles, const AffineStateConfig& config, Rng& rng) {
  const Spread spread =
      spread_of(particles, [](const Particle& one) { return !one.affine.is_identity(); });
  const double kept = std::sqrt(1.0 - config.renewal * config.renewal);
  for (Particle& particle : particles) {
    if (particle.affine.is_identity()) continue;
    Coordinates at = coordinates(particle.affine);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double sigma = std::max(config.renewal * spread.sigma[i], config.least_sigma);
      at[i] = spread.mean[i] + kept * (at[i] - spread.mean[i]) + rng.normal(0.0, sigma);
    }
    particle.affine = affine_of(at);
  }
}

void walk_affines(ParticleSet& particles, const AffineStateConfig& config, double way_m, Rng& rng) {
  const double sigma = config.drift * std::sqrt(way_m);
  if (!(sigma > 0.0)) return;
  for (Particle& particle : particles) {
    if (particle.affine.is_identity()) continue;
    Coordinates at = coordinates(particle.affine);
    for (double& coordinate : at) coordinate += rng.normal(0.0, sigma);
    particle.affine = affine_of(at);
  }
}

AffineEstimate estimate_affine(const ParticleSet& particles) {
  const Spread spread = spread_of(particles, [](const Particle&) { return true; });
  const MapAffine mean = affine_of(spread.mean);
  return {mean, mean.a * spread.sigma[0], mean.b * spread.sigma[1], spread.sigma[2]};
}

}  // namespace semview::localization
