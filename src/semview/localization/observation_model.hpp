// SPDX-License-Identifier: Apache-2.0
/// The seam between the filter and what tells good poses from bad ones.
#pragma once

#include <span>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/localization/particle_set.hpp"

namespace semview::localization {

/// How well each pose explains the current observation.
struct ObservationWeights {
  /// One a particle; -∞: impossible. A common offset changes no belief, but from observation to
  /// observation it tells how well they are explained at all.
  std::vector<double> log_weights;
  /// From a visual compass: one a particle, the heading that explains the observation best there
  /// (NaN: no reading); else empty.
  std::vector<double> headings_rad;
};

/// Weighs a batch of particles against the observation that its owner has given it.
///
/// The weight of a particle depends on its pose, on whether its yaw is known, and on the
/// observation alone, apart from rules about poses that cannot be weighed, which may look at the
/// batch. Weights that the particles have play no part. @threads for one thread at a time
class ObservationModel {
 public:
  virtual ~ObservationModel() = default;
  virtual Result<ObservationWeights> weigh(std::span<const Particle> particles) = 0;
};

}  // namespace semview::localization
