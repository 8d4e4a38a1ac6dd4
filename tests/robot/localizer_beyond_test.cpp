// SPDX-License-Identifier: Apache-2.0
// What a localizer does beyond the papers: tells when it is lost, recovers, estimates how the map
// is drawn, takes as many particles as it needs.
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "client/robot/localizer.hpp"
#include "robot/fake_score_source.hpp"
#include "semview/localization/initialization.hpp"
#include "semview/localization/odometry_motion_model.hpp"

namespace semview::robot {
namespace {

using localization::OdometryMotionConfig;
using localization::OdometryMotionModel;

/// The cells of 10 x 10 m around the map's origin.
std::vector<CellIndex> hall() {
  std::vector<CellIndex> cells;
  for (int iy = -50; iy < 50; ++iy) {
    for (int ix = -50; ix < 50; ++ix) cells.push_back({ix, iy});
  }
  return cells;
}

/// A robot that goes round in the hall, until somebody carries it away.
class Walk {
 public:
  explicit Walk(const LocalizerConfig& config, std::size_t particles = 400, std::uint64_t seed = 3)
      : localizer_(config,
                   source_,
                   std::make_shared<OdometryMotionModel>(OdometryMotionConfig{}),
                   first(particles, seed),
                   seed) {
    source_.reach_m = 6.0;
    localizer_.know_free_cells(hall());
  }

  FakeScoreSource& source() { return source_; }

  FrameReport step() {
    if (frames_++ > 0) {
      const Pose2 step{0.3, 0.0, 0.2};
      source_.truth = drawn_move(source_.truth, source_.truth * step, drawn);
      odometry_ = odometry_ * step;
    }
    return *localizer_.advance({static_cast<double>(frames_), odometry_, something()});
  }

  double error_m(const FrameReport& report) const {
    return distance_m(report.estimate.map_from_robot, source_.truth);
  }

  MapAffine drawn;  ///< what the true steps look like in the map

 private:
  static localization::ParticleSet first(std::size_t count, std::uint64_t seed) {
    Rng rng(seed, "initialization");
    return localization::gaussian_particles({0.0, 0.0, 0.0}, 0.2, 0.1, count, rng);
  }

  FakeScoreSource source_;
  Localizer localizer_;
  Pose2 odometry_;
  int frames_ = 0;
};

TEST(LocalizerBeyondTest, ARobotThatWasCarriedAwayIsLostAfterTwoFramesAndNotBefore) {
  Walk walk({});
  FrameReport report;
  for (int i = 0; i < 10; ++i) {
    report = walk.step();
    ASSERT_TRUE(report.lost_probability);
    EXPECT_LT(*report.lost_probability, 0.2) << "frame " << i;
  }
  walk.source().truth = {-3.5, -3.5, 2.0};
  const double before = *report.lost_probability;
  report = walk.step();
  EXPECT_GT(*report.lost_probability, before);
  report = walk.step();
  EXPECT_GT(*report.lost_probability, 0.5);
}

TEST(LocalizerBeyondTest, NobodyToAskLeavesTheLastJudgement) {
  Walk walk({});
  const double before = *walk.step().lost_probability;
  walk.source().broken = Error{ErrorCode::kUnavailable, "gone"};
  const FrameReport report = walk.step();
  EXPECT_EQ(report.state, FrameState::kStale);
  EXPECT_EQ(report.lost_probability, before);
  EXPECT_FALSE(report.lost_features);
}

class RecoveryTest : public testing::TestWithParam<Newcomers> {};
INSTANTIATE_TEST_SUITE_P(BothKinds,
                         RecoveryTest,
                         testing::Values(Newcomers::kUniform, Newcomers::kDense));

TEST_P(RecoveryTest, ARobotThatWasCarriedAwayIsFoundAgain) {
  LocalizerConfig config;
  config.recovery = localization::RecoveryConfig{};
  config.newcomers = GetParam();
  Walk walk(config);
  for (int i = 0; i < 10; ++i) {
    const FrameReport report = walk.step();
    EXPECT_LT(report.replaced, 40U) << "frame " << i;
  }
  walk.source().truth = {-3.5, -3.5, 2.0};
  FrameReport report = walk.step();
  EXPECT_GT(report.replaced, 40U);
  const int patience = GetParam() == Newcomers::kDense ? 4 : 20;
  for (int i = 0; i < patience; ++i) report = walk.step();
  EXPECT_LT(walk.error_m(report), 0.5);
}

TEST(LocalizerBeyondTest, AdaptiveCountsFallOnceTheRobotIsFoundAndRiseAgain) {
  LocalizerConfig config;
  config.filter.kld = localization::KldConfig{.min_particles = 50, .max_particles = 2000};
  Walk walk(config, 2000);
  FrameReport report;
  for (int i = 0; i < 12; ++i) report = walk.step();
  EXPECT_LT(report.particles, 700U);
  EXPECT_GE(report.particles, 50U);
  EXPECT_LT(walk.error_m(report), 0.3);
}

TEST(LocalizerBeyondTest, ADistortedDrawingIsEstimatedFromTheWayThroughIt) {
  LocalizerConfig config;
  config.filter.affine = localization::AffineStateConfig{};
  Walk walk(config, 1500);
  walk.drawn = {.a = 1.3, .b = 0.8, .k = 0.0};
  walk.source().reach_m = 2.0;
  FrameReport report;
  for (int i = 0; i < 60; ++i) report = walk.step();
  ASSERT_TRUE(report.affine);
  EXPECT_NEAR(report.affine->mean.a, 1.3, 0.15);
  EXPECT_NEAR(report.affine->mean.b, 0.8, 0.12);
  EXPECT_LT(report.affine->a_sigma, 0.1);
  EXPECT_LT(walk.error_m(report), 0.3);
  Walk exact({});
  EXPECT_FALSE(exact.step().affine);
}

TEST(LocalizerBeyondTest, TheDistortionsSigmaCoversItsError) {
  LocalizerConfig config;
  config.filter.affine = localization::AffineStateConfig{};
  int within_two = 0;
  int within_four = 0;
  constexpr int kSeeds = 8;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Walk walk(config, 2000, static_cast<std::uint64_t>(seed));
    walk.drawn = {.a = 1.2, .b = 0.83, .k = 0.0};
    walk.source().reach_m = 2.0;
    FrameReport report;
    for (int i = 0; i < 40; ++i) report = walk.step();
    ASSERT_TRUE(report.affine);
    const localization::AffineEstimate& found = *report.affine;
    for (const double sigmas : {(found.mean.a - walk.drawn.a) / found.a_sigma,
                                (found.mean.b - walk.drawn.b) / found.b_sigma,
                                (found.mean.k - walk.drawn.k) / found.k_sigma}) {
      within_two += std::abs(sigmas) <= 2.0 ? 1 : 0;
      within_four += std::abs(sigmas) <= 4.0 ? 1 : 0;
    }
  }
  // Of normal errors 95 % lie within two; particles of one ancestry are a little too sure.
  EXPECT_GE(within_two, 3 * kSeeds * 3 / 4);
  EXPECT_EQ(within_four, 3 * kSeeds);
}

TEST(LocalizerBeyondTest, TheRefinedEstimateIsTheTopOfTheSimilarity) {
  LocalizerConfig config;
  config.refine = true;
  Walk plain({});
  Walk refined(config);
  double plain_m = 0.0;
  double refined_m = 0.0;
  for (int i = 0; i < 20; ++i) {
    plain_m += plain.error_m(plain.step());
    refined_m += refined.error_m(refined.step());
  }
  EXPECT_LT(refined_m, plain_m);
}

TEST(LocalizerBeyondTest, TheSameSeedGivesTheSameReportsWithEverythingOn) {
  LocalizerConfig config;
  config.heading = localization::HeadingStrategy::kCombined;
  config.filter.compass = {1.0, kPi};
  config.filter.affine = localization::AffineStateConfig{.drift = 0.01};
  config.filter.kld = localization::KldConfig{};
  config.recovery = localization::RecoveryConfig{};
  config.newcomers = Newcomers::kDense;
  config.refine = true;
  Walk one(config);
  Walk other(config);
  for (int i = 0; i < 6; ++i) {
    const FrameReport a = one.step();
    const FrameReport b = other.step();
    EXPECT_EQ(a.estimate.map_from_robot, b.estimate.map_from_robot);
    EXPECT_EQ(a.lost_probability, b.lost_probability);
    EXPECT_EQ(a.particles, b.particles);
    EXPECT_EQ(a.affine->mean, b.affine->mean);
  }
}

}  // namespace
}  // namespace semview::robot
