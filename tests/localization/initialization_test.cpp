// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/initialization.hpp"

#include <cmath>
#include <map>
#include <vector>

#include <gtest/gtest.h>

namespace semview::localization {
namespace {

TEST(InitializationTest, GaussianHasMeanAndSigma) {
  constexpr std::size_t kCount = 20000;
  Rng rng(1);
  const ParticleSet particles = gaussian_particles({2.0, -3.0, kPi}, 0.4, 0.1, kCount, rng);
  double x = 0.0, x2 = 0.0, yaw2 = 0.0, weight = 0.0;
  for (const Particle& particle : particles) {
    const double dx = particle.map_from_robot.x_m - 2.0;
    const double dyaw = wrap_angle(particle.map_from_robot.yaw_rad - kPi);
    x += dx / kCount;
    x2 += dx * dx / kCount;
    yaw2 += dyaw * dyaw / kCount;
    weight += particle.weight;
    EXPECT_EQ(particle.heading_rad, particle.map_from_robot.yaw_rad);
    EXPECT_TRUE(particle.yaw_known);
  }
  const double error = 4.0 / std::sqrt(kCount);
  EXPECT_NEAR(x, 0.0, 0.4 * error);
  EXPECT_NEAR(x2, 0.16, 0.16 * std::sqrt(2.0) * error);
  EXPECT_NEAR(yaw2, 0.01, 0.01 * std::sqrt(2.0) * error);
  EXPECT_NEAR(weight, 1.0, 1e-9);
}

TEST(InitializationTest, UniformCoversEveryFreeCellEqually) {
  std::vector<CellIndex> cells;
  for (std::int32_t i = -10; i < 10; ++i) cells.push_back({3 * i, -i});
  Rng rng(2);
  const ParticleSet particles = uniform_particles(cells, 10 * cells.size(), rng);
  std::map<CellIndex, int> found;
  double cosine = 0.0;
  for (const Particle& particle : particles) {
    const auto key = PoseGrid::key(particle.map_from_robot);
    ASSERT_TRUE(key.has_value());
    ++found[key->cell];
    cosine += std::cos(particle.map_from_robot.yaw_rad);
    EXPECT_FALSE(particle.yaw_known);
  }
  ASSERT_EQ(found.size(), cells.size());
  for (const auto& entry : found) EXPECT_NEAR(entry.second, 10, 1);
  // Uniform directions: variance of a cosine is 1/2.
  const double count = static_cast<double>(particles.size());
  EXPECT_NEAR(cosine / count, 0.0, 4.0 * std::sqrt(0.5 / count));
}

}  // namespace
}  // namespace semview::localization
