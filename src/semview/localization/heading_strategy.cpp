// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/heading_strategy.hpp"

#include <cmath>

#include <fmt/format.h>

#include "semview/core/check.hpp"

namespace semview::localization {

Status validate(const CompassConfig& config) {
  if (!(config.gain >= 0.0 && config.gain <= 1.0)) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("compass gain is {}: expected 0 to 1", config.gain),
                      "gain"});
  }
  if (!(config.gate_rad >= 0.0 && config.gate_rad <= kPi)) {
    return fail(Error{
        ErrorCode::kInvalidArgument,
        fmt::format("compass gate is {:.1f} deg: expected 0 to 180", deg_from_rad(config.gate_rad)),
        "gate_rad"});
  }
  return {};
}

void apply_compass(ParticleSet& particles,
                   std::span<const double> headings_rad,
                   const CompassConfig& config) {
  SEMVIEW_CHECK(particles.size() == headings_rad.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (!std::isfinite(headings_rad[i])) continue;
    Particle& particle = particles[i];
    double& yaw_rad = particle.map_from_robot.yaw_rad;
    particle.heading_rad = wrap_angle(headings_rad[i]);
    if (!particle.yaw_known) {
      yaw_rad = particle.heading_rad;
      particle.yaw_known = true;
      continue;
    }
    const double difference_rad = wrap_angle(particle.heading_rad - yaw_rad);
    if (std::abs(difference_rad) > config.gate_rad) continue;
    yaw_rad = wrap_angle(yaw_rad + config.gain * difference_rad);
  }
}

}  // namespace semview::localization
