// SPDX-License-Identifier: Apache-2.0
#include "client/robot/localizer.hpp"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "client/robot/run_outputs.hpp"
#include "robot/fake_score_source.hpp"
#include "semview/localization/initialization.hpp"
#include "semview/localization/odometry_motion_model.hpp"

namespace semview::robot {
namespace {

using localization::HeadingStrategy;
using localization::OdometryMotionConfig;
using localization::OdometryMotionModel;

/// A robot on a circle, with odometry that turns too little: left alone it drifts off.
class Circle {
 public:
  explicit Circle(HeadingStrategy heading, std::uint64_t seed = 1)
      : localizer_(config(heading),
                   source_,
                   std::make_shared<OdometryMotionModel>(OdometryMotionConfig{}),
                   particles(seed),
                   seed) {}

  FakeScoreSource& source() { return source_; }
  const Localizer& localizer() const { return localizer_; }
  const Pose2& truth() const { return source_.truth; }
  const Pose2& odometry() const { return odometry_; }

  Result<FrameReport> step(std::optional<Observation> observation = something()) {
    if (frames_++ > 0) {
      source_.truth = source_.truth * Pose2{0.2, 0.0, 0.1};
      odometry_ = odometry_ * Pose2{0.205, 0.0, 0.09};
    }
    return localizer_.advance({static_cast<double>(frames_), odometry_, std::move(observation)});
  }

  double error_m(const FrameReport& report) const {
    return distance_m(report.estimate.map_from_robot, source_.truth);
  }

 private:
  static LocalizerConfig config(HeadingStrategy heading) {
    LocalizerConfig config;
    config.heading = heading;
    return config;
  }
  static localization::ParticleSet particles(std::uint64_t seed) {
    Rng rng(seed, "initialization");
    return localization::gaussian_particles({0.1, -0.1, 0.0}, 0.3, 0.1, 400, rng);
  }

  FakeScoreSource source_;
  Localizer localizer_;
  Pose2 odometry_{10.0, 5.0, 1.0};  // a frame of its own
  int frames_ = 0;
};

class LocalizerTest : public testing::TestWithParam<HeadingStrategy> {};
INSTANTIATE_TEST_SUITE_P(AllStrategies,
                         LocalizerTest,
                         testing::Values(HeadingStrategy::kOdometry,
                                         HeadingStrategy::kCompass,
                                         HeadingStrategy::kCombined));

TEST_P(LocalizerTest, TracksTheRobotWhileOdometryDrifts) {
  Circle drive(GetParam());
  const Pose2 start = drive.truth();
  for (int i = 0; i < 60; ++i) {
    const auto report = drive.step();
    ASSERT_TRUE(report);
    EXPECT_EQ(report->state, FrameState::kScored);
    if (i < 5) continue;
    EXPECT_LT(drive.error_m(*report), 0.25) << "frame " << i;
    const double turn = report->estimate.map_from_robot.yaw_rad - drive.truth().yaw_rad;
    EXPECT_LT(std::abs(wrap_angle(turn)), 0.2);
  }
  const Pose2 by_odometry = start * (inverse(Pose2{10.0, 5.0, 1.0}) * drive.odometry());
  EXPECT_GT(distance_m(by_odometry, drive.truth()), 0.5) << "the test must be hard enough";
}

TEST_P(LocalizerTest, SameSeedSameReportsOtherSeedOthers) {
  Circle first(GetParam(), 5);
  Circle second(GetParam(), 5);
  Circle other(GetParam(), 6);
  std::vector<FrameReport> a, b, c;
  for (int i = 0; i < 10; ++i) {
    a.push_back(*first.step());
    b.push_back(*second.step());
    c.push_back(*other.step());
  }
  EXPECT_EQ(frames_csv(a), frames_csv(b));
  EXPECT_EQ(particles_csv(first.localizer().particles()),
            particles_csv(second.localizer().particles()));
  EXPECT_NE(frames_csv(a), frames_csv(c));
}

TEST_P(LocalizerTest, StaleFramesKeepDeadReckoningAndTheFilterRecovers) {
  Circle drive(GetParam());
  FrameReport last;
  for (int i = 0; i < 10; ++i) last = *drive.step();
  drive.source().broken = Error{ErrorCode::kUnavailable, "no server"};
  for (int i = 0; i < 15; ++i) {
    const Pose2 odometry_before = drive.odometry();
    const auto report = drive.step();
    ASSERT_TRUE(report);
    EXPECT_EQ(report->state, FrameState::kStale);
    EXPECT_EQ(report->reason, "no server");
    const Pose2 expected =
        last.estimate.map_from_robot * (inverse(odometry_before) * drive.odometry());
    EXPECT_NEAR(report->estimate.map_from_robot.x_m, expected.x_m, 1e-9);
    EXPECT_NEAR(report->estimate.map_from_robot.y_m, expected.y_m, 1e-9);
    last = *report;
  }
  const double lost_sigma_m = localization::position_ellipse(last.estimate).major_sigma_m;
  EXPECT_GT(drive.error_m(last), 0.1) << "odometry alone drifts";
  drive.source().broken.reset();
  for (int i = 0; i < 5; ++i) last = *drive.step();
  EXPECT_EQ(last.state, FrameState::kScored);
  EXPECT_LT(drive.error_m(last), 0.2);
  EXPECT_LT(localization::position_ellipse(last.estimate).major_sigma_m, lost_sigma_m);
}

TEST(LocalizerStatesTest, EveryErrorThatWaitingHealsIsStaleAndNoOther) {
  for (const ErrorCode code : {ErrorCode::kUnavailable,
                               ErrorCode::kDeadlineExceeded,
                               ErrorCode::kResourceExhausted,
                               ErrorCode::kCancelled}) {
    Circle drive(HeadingStrategy::kOdometry);
    drive.source().broken = Error{code, "later"};
    const auto report = drive.step();
    ASSERT_TRUE(report);
    EXPECT_EQ(report->state, FrameState::kStale);
  }
  for (const ErrorCode code : {ErrorCode::kFailedPrecondition,
                               ErrorCode::kInvalidArgument,
                               ErrorCode::kNotFound,
                               ErrorCode::kInternal}) {
    Circle drive(HeadingStrategy::kOdometry);
    drive.source().broken = Error{code, "never"};
    const auto report = drive.step();
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, code);
  }
}

TEST(LocalizerStatesTest, NothingSeenIsNotAskedAbout) {
  Circle drive(HeadingStrategy::kOdometry);
  EXPECT_EQ(drive.step(std::nullopt)->state, FrameState::kUnseen);
  Observation dark;
  dark.labels = LabelImage(90, 360, kUnknown);
  EXPECT_EQ(drive.step(dark)->state, FrameState::kUnseen);
  EXPECT_EQ(drive.source().calls, 0);
  EXPECT_EQ(drive.step()->state, FrameState::kScored);
}

TEST(LocalizerStatesTest, NoPossibleParticleIsDeadReckoningToo) {
  Circle drive(HeadingStrategy::kOdometry);
  const FrameReport good = *drive.step();
  drive.source().reach_m = 1e-6;
  const Pose2 odometry_before = drive.odometry();
  const FrameReport report = *drive.step();
  EXPECT_EQ(report.state, FrameState::kUninformative);
  EXPECT_FALSE(report.reason.empty());
  const Pose2 expected =
      good.estimate.map_from_robot * (inverse(odometry_before) * drive.odometry());
  EXPECT_NEAR(distance_m(report.estimate.map_from_robot, expected), 0.0, 1e-9);
}

TEST(LocalizerStatesTest, CompassFindsTheHeadingFromNoIdeaOfIt) {
  FakeScoreSource source;
  source.truth = {0.25, 0.25, 2.0};
  std::vector<CellIndex> cells;
  for (std::int32_t iy = -20; iy < 20; ++iy) {
    for (std::int32_t ix = -20; ix < 20; ++ix) cells.push_back({ix, iy});
  }
  Rng rng(1, "initialization");
  LocalizerConfig config;
  config.heading = HeadingStrategy::kCompass;
  Localizer localizer(config,
                      source,
                      std::make_shared<OdometryMotionModel>(OdometryMotionConfig{}),
                      localization::uniform_particles(cells, 1000, rng),
                      1);
  Pose2 odometry;
  FrameReport report;
  for (int i = 0; i < 12; ++i) {
    if (i > 0) {
      source.truth = source.truth * Pose2{0.2, 0.0, 0.05};
      odometry = odometry * Pose2{0.2, 0.0, 0.05};
    }
    report = *localizer.advance({static_cast<double>(i), odometry, something()});
  }
  EXPECT_LT(distance_m(report.estimate.map_from_robot, source.truth), 0.3);
  const double turn = report.estimate.map_from_robot.yaw_rad - source.truth.yaw_rad;
  EXPECT_LT(std::abs(wrap_angle(turn)), 0.1);
}

TEST(RunOutputsTest, FramesAreOneLineEachAndReasonsStayInTheirField) {
  FrameReport report;
  report.stamp_s = 1.5;
  report.state = FrameState::kStale;
  report.reason = "a \"quoted\", two-\nline reason";
  report.estimate.map_from_robot = {1.0, -2.0, kPi / 2.0};
  const std::string text = frames_csv(std::vector<FrameReport>{report});
  const std::string line = text.substr(text.find('\n') + 1);
  EXPECT_EQ(line,
            "1.500000000,stale,1.000000,-2.000000,90.0000,0.0000,0.0000,0.00,0.000,0.0000,0.00,0,"
            "0.000000,0.000000,0,0,0,0,0,0,,,,,,,,\"a 'quoted', two- line reason\"\n");
}

TEST(RunOutputsTest, WhatIsKnownOfTheMapAndOfBeingLostStandsInItsColumns) {
  FrameReport report;
  report.particles = 300;
  report.replaced = 20;
  report.lost_probability = 0.25;
  report.affine = {{1.25, 0.8, -0.1}, 0.01, 0.02, 0.03};
  const std::string text = frames_csv(std::vector<FrameReport>{report});
  EXPECT_NE(text.find(",300,20,0.2500,1.25000,0.01000,0.80000,0.02000,-0.10000,0.03000,\"\"\n"),
            std::string::npos)
      << text;
}

TEST(RunOutputsTest, ParticlesCarryTheReportedHeading) {
  const localization::ParticleSet particles{{{1.0, 2.0, 0.1}, kPi, true, 0.25}};
  EXPECT_EQ(particles_csv(particles),
            "x_m,y_m,yaw_deg,weight\n1.000000,2.000000,180.0000,0.250000000\n");
}

/// The cells of 8 x 8 m around the map's origin.
std::vector<CellIndex> hall() {
  std::vector<CellIndex> cells;
  for (int iy = -40; iy < 40; ++iy) {
    for (int ix = -40; ix < 40; ++ix) cells.push_back({ix, iy});
  }
  return cells;
}

TEST(DenseStartTest, TheFirstAnsweredObservationFindsTheRobot) {
  FakeScoreSource source;
  source.truth = {2.33, -1.72, 0.9};
  Rng rng(1, "initialization");
  const auto anywhere = localization::uniform_particles(hall(), 300, rng);
  Localizer robot(
      {}, source, std::make_shared<OdometryMotionModel>(OdometryMotionConfig{}), anywhere, 5);
  robot.search(hall());

  // Nothing seen, then nobody answers, then nothing fits: the search waits.
  EXPECT_EQ(robot.advance({0.0, {}, std::nullopt})->state, FrameState::kUnseen);
  source.broken = Error{ErrorCode::kUnavailable, "away"};
  EXPECT_EQ(robot.advance({1.0, {}, something()})->state, FrameState::kStale);
  source.broken.reset();
  source.reach_m = 1e-3;
  source.truth.x_m += 100.0;
  EXPECT_EQ(robot.advance({2.0, {}, something()})->state, FrameState::kUninformative);
  EXPECT_FALSE(robot.dense_start());
  source.reach_m = 3.0;
  source.truth.x_m -= 100.0;

  source.calls = 0;
  Observation seen = something();
  seen.stamp_s = 3.0;
  const auto report = robot.advance({3.0, {}, seen});
  ASSERT_TRUE(report);
  EXPECT_EQ(report->state, FrameState::kScored);
  EXPECT_EQ(source.calls, 7);  // 6400 cells, and no particle is weighed by the same image again
  EXPECT_EQ(robot.particles().size(), 300U);
  EXPECT_LT(distance_m(report->estimate.map_from_robot, source.truth), 0.15);
  EXPECT_NEAR(report->estimate.map_from_robot.yaw_rad, 0.9, 0.05);
  EXPECT_NEAR(report->effective_sample_size, 300.0, 1e-6);
  ASSERT_TRUE(robot.dense_start());
  EXPECT_EQ(robot.dense_start()->stamp_s, 3.0);
  EXPECT_EQ(robot.dense_start()->cells, 6400U);
  ASSERT_EQ(robot.dense_start()->modes.size(), 1U);
  EXPECT_LT(distance_m(robot.dense_start()->modes[0].map_from_robot, source.truth), 0.1);

  // From then on the filter is as ever.
  source.calls = 0;
  EXPECT_EQ(robot.advance({4.0, {}, something()})->state, FrameState::kScored);
  EXPECT_EQ(source.calls, 1);
}

}  // namespace
}  // namespace semview::robot
