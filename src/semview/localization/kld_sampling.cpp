// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/kld_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "semview/core/check.hpp"

namespace semview::localization {
namespace {

using Bin = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

Bin bin_of(const Particle& particle, const KldConfig& config) {
  const auto index = [](double value, double size) {
    return static_cast<std::int64_t>(std::floor(value / size));
  };
  return {index(particle.map_from_robot.x_m, config.bin_size_m),
          index(particle.map_from_robot.y_m, config.bin_size_m),
          index(particle.heading_rad + kPi, config.bin_size_rad)};
}

}  // namespace

Status validate(const KldConfig& config) {
  const auto require = [](bool valid, const char* field, double value, const char* expected) {
    if (valid) return Status();
    return Status(fail(Error{ErrorCode::kInvalidArgument,
                             fmt::format("{} is {}: expected {}", field, value, expected),
                             field}));
  };
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  SEMVIEW_TRY_STATUS(require(positive(config.kld_err), "kld_err", config.kld_err, "a number > 0"));
  SEMVIEW_TRY_STATUS(require(positive(config.kld_z), "kld_z", config.kld_z, "a number > 0"));
  SEMVIEW_TRY_STATUS(require(config.min_particles >= 1,
                             "min_particles",
                             static_cast<double>(config.min_particles),
                             "at least 1"));
  SEMVIEW_TRY_STATUS(require(config.max_particles >= config.min_particles,
                             "max_particles",
                             static_cast<double>(config.max_particles),
                             "at least min_particles"));
  SEMVIEW_TRY_STATUS(
      require(positive(config.bin_size_m), "bin_size_m", config.bin_size_m, "a number > 0"));
  return require(config.bin_size_rad > 0.0 && config.bin_size_rad <= kTwoPi,
                 "bin_size_rad",
                 config.bin_size_rad,
                 "above 0, at most 2 pi");
}

std::size_t kld_bound(std::size_t bins, const KldConfig& config) {
  if (bins <= 1) return config.min_particles;
  const double degrees = static_cast<double>(bins - 1);  // of freedom
  const double part = 2.0 / (9.0 * degrees);
  const double root = 1.0 - part + std::sqrt(part) * config.kld_z;
  const double count = std::ceil(degrees / (2.0 * config.kld_err) * root * root * root);
  // Compared as numbers: a tiny error asks for more than fits into a size.
  if (count >= static_cast<double>(config.max_particles)) return config.max_particles;
  return std::max(config.min_particles, static_cast<std::size_t>(count));
}

std::size_t kld_sample_count(const ParticleSet& particles, const KldConfig& config, Rng& rng) {
  std::vector<double> reached;  // running sum of the weights
  reached.reserve(particles.size());
  double total = 0.0;
  for (const Particle& particle : particles) reached.push_back(total += particle.weight);
  SEMVIEW_CHECK(total > 0.0);
  std::set<Bin> occupied;
  std::size_t wanted = config.min_particles;
  std::size_t drawn = 0;
  while (drawn < wanted) {
    const auto found = std::ranges::upper_bound(reached, rng.uniform() * total);
    const auto index =
        std::min(static_cast<std::size_t>(found - reached.begin()), particles.size() - 1);
    ++drawn;
    if (occupied.insert(bin_of(particles[index], config)).second) {
      wanted = kld_bound(occupied.size(), config);
    }
  }
  return drawn;
}

}  // namespace semview::localization
