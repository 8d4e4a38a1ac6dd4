// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/particle_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "semview/core/check.hpp"

namespace semview::localization {

WeightOutcome multiply_weights(ParticleSet& particles, std::span<const double> log_weights) {
  SEMVIEW_CHECK(particles.size() == log_weights.size());
  constexpr double kImpossible = -std::numeric_limits<double>::infinity();
  std::vector<double> posterior(particles.size(), kImpossible);
  double highest = kImpossible;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (!std::isfinite(log_weights[i]) || !(particles[i].weight > 0.0)) continue;
    posterior[i] = std::log(particles[i].weight) + log_weights[i];
    highest = std::max(highest, posterior[i]);
  }
  if (!std::isfinite(highest)) return WeightOutcome::kUninformative;
  double total = 0.0;
  for (double& value : posterior) {
    value = std::exp(value - highest);
    total += value;
  }
  for (std::size_t i = 0; i < particles.size(); ++i) particles[i].weight = posterior[i] / total;
  return WeightOutcome::kUsed;
}

double effective_sample_size(const ParticleSet& particles) {
  double squares = 0.0;
  for (const Particle& particle : particles) squares += particle.weight * particle.weight;
  return squares > 0.0 ? 1.0 / squares : 0.0;
}

}  // namespace semview::localization
