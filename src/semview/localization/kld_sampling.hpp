// SPDX-License-Identifier: Apache-2.0
/// How many particles a belief needs.
#pragma once

#include <cstddef>

#include "semview/core/random.hpp"
#include "semview/core/result.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/localization/particle_set.hpp"

namespace semview::localization {

/// KLD-sampling; names as in AMCL.
struct KldConfig {
  /// Most that the Kullback-Leibler distance between the belief and the samples shall be, > 0; ε.
  double kld_err = 0.05;
  /// Upper quantile of the standard normal distribution for the share of cases in which it shall
  /// be so, > 0: 2.33 for 99 %; z_{1-δ}.
  double kld_z = 2.33;
  std::size_t min_particles = 100;   ///< >= 1
  std::size_t max_particles = 5000;  ///< >= min_particles
  double bin_size_m = 0.5;           ///< of a histogram's bin along x and y, > 0; AMCL's
  double bin_size_rad = kPi / 18.0;  ///< and in heading, in (0, 2π]
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const KldConfig& config);

/// How many samples a histogram of `bins` occupied bins asks for, between the configured bounds.
///
/// n = (k - 1)/(2ε) · (1 - 2/(9(k - 1)) + √(2/(9(k - 1))) · z)³, rounded up; the least for k <= 1.
/// @source Fox 2003, "Adapting the sample size in particle filters through KLD-sampling", eq. (12).
std::size_t kld_bound(std::size_t bins, const KldConfig& config);

/// How many samples of the belief it takes until there are as many as the bins they have fallen
/// into ask for. Drawn one by one, with replacement.
/// @param particles  not empty, weights with a sum > 0
/// @source Fox 2003, table 3.
std::size_t kld_sample_count(const ParticleSet& particles, const KldConfig& config, Rng& rng);

}  // namespace semview::localization
