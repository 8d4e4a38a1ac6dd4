// SPDX-License-Identifier: Apache-2.0
#include "semview/io/trajectory.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace semview::io {
namespace {

using semview::testing::file_bytes;
using semview::testing::TemporaryFolder;
using ::testing::HasSubstr;

TEST(TumTest, ReadsLinesCommentsAndAnySpacing) {
  const TemporaryFolder folder;
  const auto path = folder.write("a.txt",
                                 "# stamp tx ty tz qx qy qz qw\r\n"
                                 "\n"
                                 "10.5 1 2 3 0 0 0 1\r\n"
                                 "  11.25\t-1e-1  2.5 0 0 0 0.70710678 0.70710678");
  const Result<std::vector<StampedPose2>> poses = read_tum(path);
  ASSERT_TRUE(poses) << poses.error().message;
  ASSERT_EQ(poses->size(), 2U);
  EXPECT_EQ((*poses)[0], (StampedPose2{10.5, {1.0, 2.0, 0.0}}));
  EXPECT_EQ((*poses)[1].pose.x_m, -0.1);
  EXPECT_NEAR((*poses)[1].pose.yaw_rad, kPi / 2.0, 1e-9);
}

TEST(TumTest, TiltIsDroppedAndYawStays) {
  const TemporaryFolder folder;
  // Yaw 90° after a pitch of 30°: q = (0, 0, sin45, cos45) · (0, sin15, 0, cos15).
  const auto path =
      folder.write("a.txt", "0 0 0 0 -0.183012702 0.183012702 0.683012702 0.683012702\n");
  EXPECT_NEAR(read_tum(path)->front().pose.yaw_rad, kPi / 2.0, 1e-8);
}

TEST(TumTest, FaultsNameFileAndLine) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    const Result<std::vector<StampedPose2>> poses = read_tum(folder.write("a.txt", text));
    return poses ? "no error" : poses.error().message;
  };
  EXPECT_THAT(message("# only a comment\n"), HasSubstr("holds no pose"));
  EXPECT_THAT(message("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 1\n"), HasSubstr("a.txt:2: expected eight"));
  EXPECT_THAT(message("0 0 0 0 0 0 0 1 9\n"), HasSubstr("a.txt:1: expected eight"));
  EXPECT_THAT(message("0 0 0 0 0 0 0 1x\n"), HasSubstr("a.txt:1: expected eight"));
  EXPECT_THAT(message("0 nan 0 0 0 0 0 1\n"), HasSubstr("a.txt:1: expected eight"));
  EXPECT_THAT(message("\n\n0 0 0 0 0 0 0 2\n"), HasSubstr("a.txt:3: quaternion of length 2"));
  EXPECT_THAT(message("1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"), HasSubstr("a.txt:2: stamp"));
}

TEST(TumTest, WrittenPosesComeBackToNineDecimals) {
  const TemporaryFolder folder;
  const std::vector<StampedPose2> poses{{0.1, {1.0 / 3.0, -2.0, 3.0}}, {0.2, {0.0, 1e3, -3.1}}};
  ASSERT_TRUE(write_tum(folder / "a.txt", poses));
  const std::vector<StampedPose2> read = *read_tum(folder / "a.txt");
  ASSERT_EQ(read.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read[i].stamp_s, poses[i].stamp_s);
    EXPECT_NEAR(read[i].pose.x_m, poses[i].pose.x_m, 1e-9);
    EXPECT_NEAR(read[i].pose.yaw_rad, poses[i].pose.yaw_rad, 1e-8);
  }
}

TEST(TumTest, TheTextIsFixed) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_tum(folder / "a.txt", std::vector<StampedPose2>{{1.5, {-0.0, 2.0, kPi}}}));
  EXPECT_EQ(file_bytes(folder / "a.txt"),
            "# stamp tx ty tz qx qy qz qw\n"
            "1.500000000 0.000000000 2.000000000 0 0 0 1.000000000 0.000000000\n");
}

TEST(InterpolateTest, IsExactAtSamplesAndLinearBetween) {
  const std::vector<StampedPose2> poses{{1.0, {0.0, 0.0, 0.0}}, {2.0, {2.0, -4.0, 1.0}}};
  EXPECT_EQ(*interpolate(poses, 1.0), poses[0].pose);
  EXPECT_EQ(*interpolate(poses, 2.0), poses[1].pose);
  const Pose2 middle = *interpolate(poses, 1.25);
  EXPECT_DOUBLE_EQ(middle.x_m, 0.5);
  EXPECT_DOUBLE_EQ(middle.y_m, -1.0);
  EXPECT_DOUBLE_EQ(middle.yaw_rad, 0.25);
}

TEST(InterpolateTest, YawTakesTheShorterWayAcrossHalfATurn) {
  const std::vector<StampedPose2> poses{{0.0, {0.0, 0.0, 3.0}}, {1.0, {0.0, 0.0, -3.0}}};
  EXPECT_NEAR(interpolate(poses, 0.5)->yaw_rad, kPi, 1e-12);
}

TEST(InterpolateTest, OutsideTheTrajectoryIsAnError) {
  const std::vector<StampedPose2> poses{{1.0, {}}, {2.0, {}}};
  EXPECT_EQ(interpolate(poses, 0.999).error().code, ErrorCode::kOutOfRange);
  EXPECT_EQ(interpolate(poses, 2.001).error().code, ErrorCode::kOutOfRange);
  EXPECT_EQ(interpolate({}, 1.0).error().code, ErrorCode::kOutOfRange);
}

TEST(PosesTest, HeightAndTiltStay) {
  const TemporaryFolder folder;
  const auto path = folder.write("a.txt", "1 1 2 3 0.70710678 0 0 0.70710678\n");
  const Result<std::vector<StampedPose3>> poses = read_tum_poses(path);
  ASSERT_TRUE(poses) << poses.error().message;
  EXPECT_LT((poses->front().pose * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(1, 1, 3)).norm(),
            1e-9);
}

TEST(PosesTest, BetweenTwoPosesThatAreCloseInTimeAndNotBeyond) {
  const TemporaryFolder folder;
  const auto path = folder.write("a.txt",
                                 "0 0 0 0 0 0 0 1\n"
                                 "0.2 1 0 0 0 0 0.70710678 0.70710678\n"
                                 "2 1 0 0 0 0 0 1\n");
  const std::vector<StampedPose3> poses = *read_tum_poses(path);
  const Result<Eigen::Isometry3d> between = interpolate(poses, 0.1, 0.25);
  ASSERT_TRUE(between) << between.error().message;
  const double half = std::sqrt(0.5);
  EXPECT_LT((*between * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0.5 + half, half, 0)).norm(),
            1e-8);
  EXPECT_TRUE(interpolate(poses, 2.0, 0.25)) << "a sample's own stamp";
  EXPECT_THAT(interpolate(poses, 1.0, 0.25).error().message, HasSubstr("1.800 s apart"));
  EXPECT_EQ(interpolate(poses, -0.1, 0.25).error().code, ErrorCode::kOutOfRange);
  EXPECT_EQ(interpolate(poses, 2.1, 0.25).error().code, ErrorCode::kOutOfRange);
}

TEST(PosesTest, ALostTrackerLosesItsOwnStretchOnly) {
  const TemporaryFolder folder;
  const auto path = folder.write("a.txt",
                                 "0 0 0 0 0 0 0 1\n"
                                 "0.1 nan nan nan nan nan nan nan\n"
                                 "0.2 1 0 0 0 0 0 1\n");
  const Result<std::vector<StampedPose3>> poses = read_tum_poses(path);
  ASSERT_TRUE(poses) << poses.error().message;
  EXPECT_TRUE(interpolate(*poses, 0.0, 1.0));
  EXPECT_TRUE(interpolate(*poses, 0.2, 1.0));
  for (const double stamp_s : {0.05, 0.1, 0.15}) {
    EXPECT_THAT(interpolate(*poses, stamp_s, 1.0).error().message, HasSubstr("lost"));
  }
  EXPECT_FALSE(read_tum(path)) << "planar trajectories have no gaps";
}

}  // namespace
}  // namespace semview::io
