// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/annealed_start.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace semview::localization {
namespace {

/// Two Gaussian places of unequal weight, and a distortion that it tells.
class TwoPlaces final : public ObservationModel {
 public:
  Pose2 first{-3.0, 1.0, 0.5};
  Pose2 second{4.0, -2.0, -1.0};
  double second_weight = 3.0;
  double sigma_m = 0.2;
  double a = 1.3;
  double a_sigma = 0.04;
  bool tells_distortion = false;

  Result<ObservationWeights> weigh(std::span<const Particle> particles) override {
    ObservationWeights weights;
    for (const Particle& particle : particles) {
      const double near = bump(particle.map_from_robot, first);
      const double far = second_weight * bump(particle.map_from_robot, second);
      double log_weight = std::log(near + far + 1e-40);
      if (tells_distortion) {
        const double off = (std::log(particle.affine.a) - std::log(a)) / a_sigma;
        log_weight -= 0.5 * off * off;
      }
      weights.log_weights.push_back(log_weight);
      weights.headings_rad.push_back(near > far ? first.yaw_rad : second.yaw_rad);
    }
    return weights;
  }

 private:
  double bump(const Pose2& pose, const Pose2& center) const {
    const double off = distance_m(pose, center) / sigma_m;
    return std::exp(-0.5 * off * off);
  }
};

class Impossible final : public ObservationModel {
 public:
  Result<ObservationWeights> weigh(std::span<const Particle> particles) override {
    return ObservationWeights{
        std::vector<double>(particles.size(), -std::numeric_limits<double>::infinity()), {}};
  }
};

std::vector<CellIndex> floor_cells() {
  std::vector<CellIndex> cells;
  for (std::int32_t ix = -60; ix < 60; ++ix) {
    for (std::int32_t iy = -40; iy < 40; ++iy) cells.push_back({ix, iy});
  }
  return cells;
}

const AnnealedStartConfig kQuick{.hypotheses = 4000, .survivors = 2000};

TEST(AnnealedStartTest, PlacesGetAsManyParticlesAsTheyAreProbable) {
  TwoPlaces model;
  Rng rng(1);
  const auto particles = annealed_particles(model, floor_cells(), std::nullopt, kQuick, 1000, rng);
  ASSERT_TRUE(particles);
  ASSERT_EQ(particles->size(), 1000u);
  int near_first = 0;
  double square = 0.0;
  for (const Particle& particle : *particles) {
    EXPECT_DOUBLE_EQ(particle.weight, 1e-3);
    EXPECT_TRUE(particle.yaw_known);
    EXPECT_EQ(particle.map_from_robot.yaw_rad, particle.heading_rad);
    const bool is_first = distance_m(particle.map_from_robot, model.first) < 2.0;
    near_first += is_first ? 1 : 0;
    const Pose2& center = is_first ? model.first : model.second;
    EXPECT_EQ(particle.heading_rad, center.yaw_rad);
    square += std::pow(distance_m(particle.map_from_robot, center), 2) / 1000.0;
  }
  // One in four, drawn from 2000 correlated survivors that came from few hypotheses.
  EXPECT_NEAR(near_first, 250, 100);
  EXPECT_NEAR(std::sqrt(square), model.sigma_m * std::sqrt(2.0), 0.03);
}

TEST(AnnealedStartTest, ASmallerPowerKeepsMoreOfTheWeakerPlace) {
  TwoPlaces model;
  model.second_weight = 100.0;
  AnnealedStartConfig config = kQuick;
  config.exponent = 0.25;
  Rng rng(5);
  const auto particles = annealed_particles(model, floor_cells(), std::nullopt, config, 1000, rng);
  ASSERT_TRUE(particles);
  const auto near_first = std::ranges::count_if(*particles, [&](const Particle& particle) {
    return distance_m(particle.map_from_robot, model.first) < 2.0;
  });
  // 1 : 100^0.25
  EXPECT_NEAR(static_cast<double>(near_first), 240.0, 100.0);
}

TEST(AnnealedStartTest, TheDistortionIsFoundWithThePlace) {
  TwoPlaces model;
  model.tells_distortion = true;
  Rng rng(2);
  AffineStateConfig affine;
  const auto particles = annealed_particles(model, floor_cells(), affine, kQuick, 1000, rng);
  ASSERT_TRUE(particles);
  // Normal prior times normal likelihood, in ln a; the exact share has no part in it (6 σ off).
  const double prior = 1.0 / (affine.log_scale_sigma * affine.log_scale_sigma);
  const double told = 1.0 / (model.a_sigma * model.a_sigma);
  double mean_log_a = 0.0;
  double b_square = 0.0;
  for (const Particle& particle : *particles) {
    mean_log_a += std::log(particle.affine.a) / 1000.0;
    b_square += std::pow(std::log(particle.affine.b), 2) / 1000.0;
  }
  EXPECT_NEAR(mean_log_a, std::log(model.a) * told / (told + prior), 0.01);
  EXPECT_NEAR(std::sqrt(b_square), affine.log_scale_sigma, 0.06) << "nothing was said of b";
}

TEST(AnnealedStartTest, EqualSeedsGiveEqualParticlesOnFreeCells) {
  TwoPlaces model;
  model.first = {-6.0, 0.0, 0.0};  // at the floor's border
  const std::vector<CellIndex> cells = floor_cells();
  Rng rng(3);
  Rng same(3);
  const auto particles = annealed_particles(model, cells, AffineStateConfig{}, kQuick, 500, rng);
  ASSERT_TRUE(particles);
  EXPECT_EQ(*particles, *annealed_particles(model, cells, AffineStateConfig{}, kQuick, 500, same));
  for (const Particle& particle : *particles) {
    EXPECT_GE(particle.map_from_robot.x_m, -6.0);
  }
}

TEST(AnnealedStartTest, AnImpossibleObservationIsAnError) {
  Impossible model;
  Rng rng(4);
  const auto particles = annealed_particles(model, floor_cells(), std::nullopt, kQuick, 10, rng);
  ASSERT_FALSE(particles);
  EXPECT_EQ(particles.error().code, ErrorCode::kFailedPrecondition);
}

TEST(AnnealedStartTest, ConfigurationsAreChecked) {
  EXPECT_TRUE(validate(AnnealedStartConfig{}));
  const auto field = [](AnnealedStartConfig config) { return validate(config).error().field; };
  EXPECT_EQ(field({.survivors = 0}), "survivors");
  EXPECT_EQ(field({.hypotheses = 10}), "hypotheses");
  EXPECT_EQ(field({.exponent = 1.5}), "exponent");
  EXPECT_EQ(field({.keep = 1.0}), "keep");
  EXPECT_EQ(field({.most_rounds = 0}), "most_rounds");
  EXPECT_EQ(field({.moves = 0}), "moves");
  EXPECT_EQ(field({.move_m = 0.0}), "move_m");
  EXPECT_EQ(field({.move_affine = std::nan("")}), "move_affine");
}

}  // namespace
}  // namespace semview::localization
