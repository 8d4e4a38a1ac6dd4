// SPDX-License-Identifier: Apache-2.0
#include "semview/evaluation/poses_at.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/io/text_file.hpp"
#include "support/temporary_folder.hpp"

namespace semview::evaluation {
namespace {

using ::testing::HasSubstr;

class ReadPosesAtTest : public ::testing::Test {
 protected:
  /// Of frames at 1, 2 and 3 s.
  Result<std::vector<Pose2>> read(const std::string& text) {
    EXPECT_TRUE(io::write_text_file(folder_ / "a.tum", text));
    return read_poses_at(folder_ / "a.tum", stamps_s_);
  }

  std::string message(const std::string& text) {
    const auto poses = read(text);
    return poses ? "" : poses.error().message;
  }

  testing::TemporaryFolder folder_;
  std::vector<double> stamps_s_ = {1.0, 2.0, 3.0};
};

constexpr const char* kOne = "1 10 0 0 0 0 0 1\n";
constexpr const char* kTwo = "2.0004 20 0 0 0 0 0 1\n";
constexpr const char* kThree = "3 30 0 0 0 0 0 1\n";

TEST_F(ReadPosesAtTest, EachFrameHasItsPose) {
  const auto poses = read(std::string(kOne) + kTwo + kThree);
  ASSERT_TRUE(poses) << poses.error().message;
  ASSERT_EQ(poses->size(), 3U);
  EXPECT_EQ((*poses)[1].x_m, 20.0);
}

TEST_F(ReadPosesAtTest, AMissingPoseIsNamedByItsFrame) {
  EXPECT_THAT(message(std::string(kOne) + kTwo), HasSubstr("a.tum: no pose at 3 s, frame 3 of 3"));
  EXPECT_THAT(message(std::string(kTwo) + kThree), HasSubstr("no pose at 1 s, frame 1 of 3"));
  EXPECT_THAT(message(std::string(kOne) + kThree), HasSubstr("no pose at 2 s, frame 2 of 3"));
}

TEST_F(ReadPosesAtTest, APoseBetweenOrBeyondFramesIsRefused) {
  EXPECT_THAT(message(std::string(kOne) + "1.5 0 0 0 0 0 0 1\n" + kTwo + kThree),
              HasSubstr("the pose at 1.5 s belongs to no frame"));
  EXPECT_THAT(message(std::string(kOne) + kTwo + kThree + "4 0 0 0 0 0 0 1\n"),
              HasSubstr("the pose at 4 s belongs to no frame"));
}

TEST_F(ReadPosesAtTest, PosesOfSkippedFramesArePassedOver) {
  ASSERT_TRUE(read(std::string(kOne) + kTwo + kThree));
  const std::vector<double> wanted_s{1.0, 3.0};
  const std::vector<double> skipped_s{2.0};
  const auto poses = read_poses_at(folder_ / "a.tum", wanted_s, skipped_s);
  ASSERT_TRUE(poses) << poses.error().message;
  EXPECT_EQ((*poses)[1].x_m, 30.0);
  EXPECT_FALSE(read_poses_at(folder_ / "a.tum", wanted_s));
}

TEST_F(ReadPosesAtTest, WhatIsNoNumberIsRefusedWithItsLine) {
  EXPECT_THAT(message(std::string(kOne) + "2 nan 0 0 0 0 0 1\n" + kThree),
              HasSubstr("a.tum:2: expected eight finite numbers"));
}

}  // namespace
}  // namespace semview::evaluation
