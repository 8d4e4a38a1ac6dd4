// SPDX-License-Identifier: Apache-2.0
/// When a filter has lost its robot: fresh particles in the place of some.
#pragma once

#include "semview/core/result.hpp"

namespace semview::localization {

/// Augmented MCL; names as in AMCL. Both must be above 0.
struct RecoveryConfig {
  /// Decay of the long-term average of the likelihood, in (0, 1). AMCL's 0.001 belongs to ten and
  /// more scans a second; ours are metres apart.
  double recovery_alpha_slow = 0.05;
  double recovery_alpha_fast = 0.5;  ///< and of the short-term one, in (recovery_alpha_slow, 1]
  /// Most of the particles that are replaced at once, in (0, 1].
  double most_share = 0.5;
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const RecoveryConfig& config);

/// Follows how well observations are explained, and says how many particles to give up.
///
/// differs: the source averages likelihoods, which for panoramas vary by powers of ten from one
/// place to the next with nothing lost; here it is their twentieth root, with the default weights
/// the similarity itself.
/// @source Thrun, Burgard, Fox 2005, table 8.3.
class RecoveryMonitor {
 public:
  explicit RecoveryMonitor(const RecoveryConfig& config) : config_(config) {}

  /// The share of the particles to draw anew, max(0, 1 - w_fast / w_slow), after an observation
  /// whose mean likelihood over the particles was `average` (`UpdateReport::mean_likelihood`).
  double share_to_replace(double average);

 private:
  RecoveryConfig config_;
  double slow_ = 0.0;  ///< 0: nothing seen yet
  double fast_ = 0.0;
};

}  // namespace semview::localization
