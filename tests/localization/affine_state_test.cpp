// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/affine_state.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace semview::localization {
namespace {

ParticleSet many(std::size_t count) {
  ParticleSet particles(count);
  for (Particle& particle : particles) particle.weight = 1.0 / static_cast<double>(count);
  return particles;
}

TEST(AffineStateTest, ThePriorHasItsShareOfExactMapsAndItsSpread) {
  ParticleSet particles = many(20000);
  Rng rng(3);
  spread_affines(
      particles, {.identity_share = 0.25, .log_scale_sigma = 0.2, .shear_sigma = 0.1}, rng);
  const auto exact = std::ranges::count_if(
      particles, [](const Particle& one) { return one.affine.is_identity(); });
  // Five standard deviations of a binomial share.
  EXPECT_NEAR(static_cast<double>(exact) / 20000.0, 0.25, 5.0 * std::sqrt(0.25 * 0.75 / 20000.0));
  const AffineEstimate estimate = estimate_affine(particles);
  EXPECT_NEAR(estimate.a_sigma, 0.2 * std::sqrt(0.75), 0.01);
  EXPECT_NEAR(estimate.k_sigma, 0.1 * std::sqrt(0.75), 0.005);
}

TEST(AffineStateTest, RenewalKeepsMeanAndSpreadAndExactMaps) {
  ParticleSet particles = many(20000);
  Rng rng(4);
  spread_affines(
      particles, {.identity_share = 0.0, .log_scale_sigma = 0.1, .shear_sigma = 0.05}, rng);
  particles[7].affine = {};
  const AffineEstimate before = estimate_affine(particles);
  for (int i = 0; i < 10; ++i) renew_affines(particles, {.renewal = 0.3, .least_sigma = 0.0}, rng);
  const AffineEstimate after = estimate_affine(particles);
  EXPECT_NEAR(after.mean.a, before.mean.a, 0.005);
  EXPECT_NEAR(after.a_sigma, before.a_sigma, 0.005);
  EXPECT_NEAR(after.k_sigma, before.k_sigma, 0.003);
  EXPECT_TRUE(particles[7].affine.is_identity());
}

TEST(AffineStateTest, ADrawingThatDiffersFromPlaceToPlaceWalksWithTheRootOfTheWay) {
  const AffineStateConfig config{.drift = 0.02};
  for (const double way_m : {0.0, 1.0, 4.0}) {
    ParticleSet particles = many(20000);
    Rng rng(4);
    for (Particle& particle : particles) particle.affine = {.a = 1.1};
    particles[7].affine = {};
    walk_affines(particles, config, way_m, rng);
    const AffineEstimate estimate = estimate_affine(particles);
    EXPECT_NEAR(estimate.k_sigma, 0.02 * std::sqrt(way_m), 0.0005);
    EXPECT_NEAR(estimate.b_sigma, 0.02 * std::sqrt(way_m), 0.0005);
    EXPECT_NEAR(estimate.mean.a, 1.1, 0.001);
    EXPECT_TRUE(particles[7].affine.is_identity());
  }
}

TEST(AffineStateTest, TheEstimateIsTheWeightedMeanOfLogarithms) {
  ParticleSet particles = many(2);
  particles[0].weight = 0.75;
  particles[1].weight = 0.25;
  particles[0].affine = {.a = 1.0, .b = 1.0, .k = 0.4};
  particles[1].affine = {.a = 2.0, .b = 0.5, .k = 0.0};
  const AffineEstimate estimate = estimate_affine(particles);
  EXPECT_NEAR(estimate.mean.a, std::pow(2.0, 0.25), 1e-12);
  EXPECT_NEAR(estimate.mean.b, std::pow(0.5, 0.25), 1e-12);
  EXPECT_NEAR(estimate.mean.k, 0.3, 1e-12);
}

TEST(AffineStateTest, ParametersOutOfRangeAreNamed) {
  EXPECT_EQ(validate(AffineStateConfig{.identity_share = 1.1}).error().field, "identity_share");
  EXPECT_EQ(validate(AffineStateConfig{.renewal = -0.1}).error().field, "renewal");
  EXPECT_EQ(validate(AffineStateConfig{.drift = -1.0}).error().field, "drift");
  EXPECT_TRUE(validate(AffineStateConfig{}));
}

TEST(AffineGridTest, KeepsTheIdentityAndIsItsOwnNearest) {
  EXPECT_TRUE(on_affine_grid({}).is_identity());
  EXPECT_TRUE(on_affine_grid({.a = 1.009, .b = 0.991, .k = -0.009}).is_identity());
  const MapAffine once = on_affine_grid({.a = 1.234, .b = 0.7, .k = 0.33});
  EXPECT_EQ(on_affine_grid(once), once);
  EXPECT_NEAR(std::log(once.a), std::log(1.234), kAffineStep / 2.0);
  EXPECT_NEAR(once.k, 0.33, kAffineStep / 2.0 + 1e-12);
}

}  // namespace
}  // namespace semview::localization
