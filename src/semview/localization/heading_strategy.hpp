// SPDX-License-Identifier: Apache-2.0
/// Where a particle's heading comes from: odometry, or a visual compass.
#pragma once

#include <span>

#include "semview/core/result.hpp"
#include "semview/localization/particle_set.hpp"

namespace semview::localization {

/// @source Neubert et al. 2017, section III-D.
enum class HeadingStrategy {
  kOdometry,  ///< the sampled yaw is scored and reported
  kCompass,   ///< every heading is scored, the best counts and is reported
  /// Every heading is scored and weighed by how near it is to the one that odometry says: the
  /// paper's future work (section V). The choice goes on as the particle's yaw.
  kCombined,
};

/// What a compass reading does to the yaw that the next odometry steps are turned by.
///
/// The paper leaves it open. Turning steps by the compass throws a particle off its way whenever
/// another direction happens to look alike; never doing it lets odometry's drift in heading grow
/// without bound. So a reading corrects a share of a small difference and none of a large one.
struct CompassConfig {
  double gain = 0.1;  ///< share of the difference taken over, in [0, 1]; 0 keeps steps in odometry
  double gate_rad = kPi / 9.0;  ///< differences above this correct nothing; in [0, π]
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const CompassConfig& config);

/// Takes over compass readings, one a particle: as reported heading always, as yaw entirely where
/// the yaw was unknown, else as `config` says. NaN: no reading, nothing changes.
void apply_compass(ParticleSet& particles,
                   std::span<const double> headings_rad,
                   const CompassConfig& config);

}  // namespace semview::localization
