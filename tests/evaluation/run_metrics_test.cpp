// SPDX-License-Identifier: Apache-2.0
#include "semview/evaluation/run_metrics.hpp"

#include <gtest/gtest.h>

namespace semview::evaluation {
namespace {

using io::StampedPose2;
using Trajectory = std::vector<StampedPose2>;

/// Straight along x at 1 m/s, a sample a second.
Trajectory straight(int seconds) {
  Trajectory poses;
  for (int t = 0; t <= seconds; ++t) poses.push_back({t + 0.0, {t + 0.0, 0.0, 0.0}});
  return poses;
}

TEST(CompareTest, TheTruthItselfHasNoError) {
  const Result<TrackErrors> errors = compare(straight(10), straight(10));
  ASSERT_TRUE(errors);
  EXPECT_EQ(errors->stamps, 11U);
  EXPECT_EQ(errors->position_m.max, 0.0);
  EXPECT_EQ(errors->heading_rad.max, 0.0);
  EXPECT_EQ(errors->converged_after_s, 0.0);
}

TEST(CompareTest, SummariesAreThoseOfTheErrorsAtItsOwnStamps) {
  // Between the truth's samples; errors 3, 0.2, 0.4, 0.1 m sideways and 0.1 to 0.4 rad.
  const Trajectory poses{{0.5, {0.5, 3.0, 0.1}},
                         {1.5, {1.5, -0.2, -0.2}},
                         {2.25, {2.25, 0.4, 0.3}},
                         {3.0, {3.0, 0.1, -0.4}}};
  const Result<TrackErrors> errors = compare(poses, straight(3));
  ASSERT_TRUE(errors);
  EXPECT_NEAR(errors->position_m.mean, 0.925, 1e-12);
  EXPECT_NEAR(errors->position_m.median, 0.3, 1e-12);
  EXPECT_NEAR(errors->position_m.max, 3.0, 1e-12);
  EXPECT_NEAR(errors->position_m.final, 0.1, 1e-12);
  EXPECT_NEAR(errors->heading_rad.mean, 0.25, 1e-12);
  EXPECT_NEAR(errors->heading_rad.final, 0.4, 1e-12);
}

TEST(CompareTest, HeadingErrorsGoTheShorterWay) {
  const Trajectory truth{{0.0, {0.0, 0.0, 3.1}}};
  const Trajectory poses{{0.0, {0.0, 0.0, -3.1}}};
  EXPECT_NEAR(compare(poses, truth)->heading_rad.max, kTwoPi - 6.2, 1e-12);
}

TEST(CompareTest, ConvergedMeansBelowTheLimitToTheEnd) {
  Trajectory poses = straight(6);
  const auto converged = [&] { return compare(poses, straight(6))->converged_after_s; };
  poses[0].pose.y_m = 2.0;
  poses[2].pose.y_m = 0.7;  // once more outside
  poses[4].pose.y_m = 0.49;
  EXPECT_EQ(converged(), 3.0);
  poses[6].pose.y_m = 0.5;  // the limit itself is not below it
  EXPECT_EQ(converged(), std::nullopt);
  EXPECT_EQ(compare(poses, straight(6), 0.6)->converged_after_s, 3.0);
}

TEST(CompareTest, StampsOutsideTheTruthAreCountedNotCompared) {
  const Result<TrackErrors> errors = compare(straight(10), straight(4));
  ASSERT_TRUE(errors);
  EXPECT_EQ(errors->stamps, 5U);
  EXPECT_EQ(errors->skipped, 6U);
  EXPECT_EQ(compare(Trajectory{{99.0, {}}}, straight(4)).error().code, ErrorCode::kOutOfRange);
  EXPECT_EQ(compare({}, straight(4)).error().code, ErrorCode::kOutOfRange);
}

TEST(AlignOdometryTest, MeetsTheTruthAtTheFirstCommonStampAndDriftsFromThere) {
  // The same drive in a frame that is turned by 90° and elsewhere; the truth begins late.
  const Trajectory truth{{2.0, {2.0, 0.0, 0.0}}, {4.0, {4.0, 0.0, 0.0}}};
  Trajectory odometry;
  for (int t = 0; t <= 4; ++t) odometry.push_back({t + 0.0, {7.0, t + 1.0, kPi / 2.0}});
  const Result<Trajectory> aligned = align_odometry(odometry, truth);
  ASSERT_TRUE(aligned);
  ASSERT_EQ(aligned->size(), 3U);
  const Result<TrackErrors> errors = compare(*aligned, truth);
  EXPECT_NEAR(errors->position_m.max, 0.0, 1e-12);
  EXPECT_NEAR(errors->heading_rad.max, 0.0, 1e-12);
}

TEST(AlignOdometryTest, WithoutCommonTimeIsAnError) {
  EXPECT_EQ(align_odometry(Trajectory{{0.0, {}}}, Trajectory{{5.0, {}}}).error().code,
            ErrorCode::kOutOfRange);
  EXPECT_EQ(align_odometry({}, straight(1)).error().code, ErrorCode::kOutOfRange);
}

TEST(SampleTest, LeavesOutWhatIsNotCovered) {
  const Trajectory at{{-1.0, {}}, {0.5, {}}, {3.0, {}}};
  const Trajectory sampled = sample(straight(2), at);
  ASSERT_EQ(sampled.size(), 1U);
  EXPECT_EQ(sampled[0], (StampedPose2{0.5, {0.5, 0.0, 0.0}}));
}

}  // namespace
}  // namespace semview::evaluation
