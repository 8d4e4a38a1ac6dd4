// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/kld_sampling.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "semview/localization/initialization.hpp"

namespace semview::localization {
namespace {

KldConfig unbounded() { return {.min_particles = 1, .max_particles = 1'000'000'000}; }

/// The 99 % quantiles of chi-square for 1 to 100 degrees of freedom, from tables.
struct Quantile {
  std::size_t degrees;
  double value;
};
const std::vector<Quantile> kChiSquare99{
    {1, 6.635}, {2, 9.210}, {5, 15.086}, {10, 23.209}, {30, 50.892}, {50, 76.154}, {100, 135.807}};

TEST(KldSamplingTest, TheBoundIsChiSquareOverTwiceTheError) {
  // Fox 2003, eq. (9), of which eq. (12) is the Wilson-Hilferty approximation.
  for (const double error : {0.01, 0.05, 0.2}) {
    KldConfig config = unbounded();
    config.kld_err = error;
    config.kld_z = 2.3263;
    for (const auto& [degrees, value] : kChiSquare99) {
      const double exact = value / (2.0 * error);
      const auto bound = static_cast<double>(kld_bound(degrees + 1, config));
      EXPECT_NEAR(bound, exact, 0.015 * exact + 1.0) << degrees << " at " << error;
    }
  }
}

TEST(KldSamplingTest, TheBoundGrowsWithTheBinsAndStaysWithinItsLimits) {
  KldConfig config;
  std::size_t before = 0;
  for (std::size_t bins = 0; bins < 2000; ++bins) {
    const std::size_t bound = kld_bound(bins, config);
    EXPECT_GE(bound, before);
    EXPECT_GE(bound, config.min_particles);
    EXPECT_LE(bound, config.max_particles);
    before = bound;
  }
  EXPECT_EQ(kld_bound(0, config), config.min_particles);
  EXPECT_EQ(kld_bound(1, config), config.min_particles);
  EXPECT_EQ(before, config.max_particles);
  config.kld_err = 1e-300;
  EXPECT_EQ(kld_bound(100, config), config.max_particles);
}

TEST(KldSamplingTest, ABeliefInOneBinTakesTheFewestAndASpreadOneManyMore) {
  const KldConfig config;
  Rng rng(1, "test");
  const ParticleSet sure = gaussian_particles({0.25, 0.25, 0.08}, 0.01, 0.005, 1000, rng);
  EXPECT_EQ(kld_sample_count(sure, config, rng), config.min_particles);
  const ParticleSet near = gaussian_particles({0.0, 0.0, 0.0}, 0.5, 0.1, 1000, rng);
  const ParticleSet far = gaussian_particles({0.0, 0.0, 0.0}, 5.0, 2.0, 1000, rng);
  const std::size_t some = kld_sample_count(near, config, rng);
  const std::size_t many = kld_sample_count(far, config, rng);
  EXPECT_GT(some, config.min_particles);
  EXPECT_GT(many, 3 * some);
  EXPECT_LE(many, config.max_particles);
}

TEST(KldSamplingTest, WhatHasNoWeightNeedsNoSamples) {
  Rng rng(1, "test");
  ParticleSet particles = gaussian_particles({0.25, 0.25, 0.08}, 0.01, 0.005, 10, rng);
  ParticleSet far = gaussian_particles({0.0, 0.0, 0.0}, 50.0, 2.0, 500, rng);
  for (Particle& particle : far) particle.weight = 0.0;
  particles.insert(particles.end(), far.begin(), far.end());
  const KldConfig config;
  EXPECT_EQ(kld_sample_count(particles, config, rng), config.min_particles);
}

/// What the bound is for: in 99 of 100 cases the samples' histogram is near the belief's.
TEST(KldSamplingTest, TheSamplesAreAsNearToTheBeliefAsPromised) {
  // A belief over 40 bins along x, of unequal weight.
  ParticleSet belief(40);
  double total = 0.0;
  for (std::size_t i = 0; i < belief.size(); ++i) {
    belief[i].map_from_robot.x_m = 0.5 * static_cast<double>(i) + 0.25;
    total += belief[i].weight = 1.0 + static_cast<double>(i % 7);
  }
  for (Particle& particle : belief) particle.weight /= total;
  const KldConfig config{.min_particles = 10};
  Rng rng(2, "test");
  int misses = 0;
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::size_t count = kld_sample_count(belief, config, rng);
    std::vector<double> histogram(belief.size());
    for (std::size_t k = 0; k < count; ++k) {
      double mark = rng.uniform();
      std::size_t i = 0;
      while (i + 1 < belief.size() && mark >= belief[i].weight) mark -= belief[i++].weight;
      histogram[i] += 1.0 / static_cast<double>(count);
    }
    double distance = 0.0;  // Kullback-Leibler, of the samples from the belief
    for (std::size_t i = 0; i < belief.size(); ++i) {
      if (histogram[i] > 0.0) distance += histogram[i] * std::log(histogram[i] / belief[i].weight);
    }
    misses += distance > config.kld_err ? 1 : 0;
  }
  // 1 % of 400, and four standard deviations of that.
  EXPECT_LE(misses, 12);
}

TEST(KldSamplingTest, ParametersOutOfRangeAreNamed) {
  EXPECT_TRUE(validate(KldConfig{}));
  EXPECT_EQ(validate(KldConfig{.kld_err = 0.0}).error().field, "kld_err");
  EXPECT_EQ(validate(KldConfig{.kld_z = NAN}).error().field, "kld_z");
  EXPECT_EQ(validate(KldConfig{.min_particles = 0}).error().field, "min_particles");
  EXPECT_EQ(validate(KldConfig{.min_particles = 9, .max_particles = 8}).error().field,
            "max_particles");
}

}  // namespace
}  // namespace semview::localization
