// SPDX-License-Identifier: Apache-2.0
#include "client/robot/run_log_player.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "client/robot/run_outputs.hpp"
#include "robot/fake_score_source.hpp"
#include "semview/localization/initialization.hpp"
#include "semview/localization/odometry_motion_model.hpp"

namespace semview::robot {
namespace {

/// A log of ten frames, one a second, 0.2 m apart on a straight line; removed at the end.
class RunLogPlayerTest : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() /
                 ("semview_player_" + std::to_string(::getpid()) + "_" +
                  testing::UnitTest::GetInstance()->current_test_info()->name());
    io::ObservationSetup setup;
    setup.classes = ClassTable({"wall"});
    setup.camera = PartialPanorama{};
    auto writer = io::RunLogWriter::create(directory_, setup);
    ASSERT_TRUE(writer) << writer.error().message;
    for (int i = 0; i < 10; ++i) {
      ASSERT_TRUE(writer->add_frame(i, LabelImage(90, 360, 1)));
      odometry_.push_back({static_cast<double>(i), {0.2 * i, 0.0, 0.0}});
    }
  }

  void TearDown() override { std::filesystem::remove_all(directory_); }

  io::RunLog log_with(const std::vector<io::StampedPose2>& odometry) {
    io::RunLog log;
    log.directory = directory_;
    log.setup.classes = ClassTable({"wall"});
    log.setup.camera = PartialPanorama{};
    log.odometry = odometry;
    for (int i = 0; i < 10; ++i) {
      log.frames.push_back({static_cast<double>(i), labels_name(i), "", ""});
    }
    return log;
  }

  Localizer localizer(FakeScoreSource& source) {
    Rng rng(1, "initialization");
    return Localizer(
        {},
        source,
        std::make_shared<localization::OdometryMotionModel>(localization::OdometryMotionConfig{}),
        localization::gaussian_particles({5.0, 1.0, 0.0}, 0.1, 0.1, 200, rng),
        1);
  }

  static std::string labels_name(int index) {
    const std::string number = std::to_string(index);
    return "labels/" + std::string(6 - number.size(), '0') + number + ".png";
  }

  std::filesystem::path directory_;
  std::vector<io::StampedPose2> odometry_;
};

TEST_F(RunLogPlayerTest, PlaysEveryFrameInOrderAndTracksIt) {
  FakeScoreSource source;
  Localizer robot = localizer(source);
  std::vector<double> waited;
  std::vector<std::size_t> shown;
  PlayerHooks hooks;
  hooks.wait_until = [&](double stamp_s) {
    waited.push_back(stamp_s);
    source.truth = {5.0 + 0.2 * stamp_s, 1.0, 0.0};
  };
  hooks.on_frame = [&](const FrameReport&, std::size_t done, std::size_t total) {
    shown.push_back(done);
    EXPECT_EQ(total, 10U);
  };
  const auto drive = play(log_with(odometry_), PanoramaCamera{}, robot, hooks);
  ASSERT_TRUE(drive) << drive.error().message;
  ASSERT_EQ(drive->frames.size(), 10U);
  EXPECT_EQ(waited.front(), 0.0);
  EXPECT_EQ(waited.back(), 9.0);
  EXPECT_EQ(shown.back(), 10U);
  EXPECT_EQ(drive->frames_without_odometry, 0U);
  const auto track = trajectory(drive->frames);
  EXPECT_NEAR(track.back().pose.x_m, 6.8, 0.15);
  EXPECT_NEAR(track.back().pose.y_m, 1.0, 0.15);
}

TEST_F(RunLogPlayerTest, FramesOutsideTheOdometryAreLeftOutAndCounted) {
  FakeScoreSource source;
  Localizer robot = localizer(source);
  const std::vector<io::StampedPose2> middle(odometry_.begin() + 2, odometry_.end() - 3);
  const auto drive = play(log_with(middle), PanoramaCamera{}, robot);
  ASSERT_TRUE(drive);
  EXPECT_EQ(drive->frames.size(), 5U);
  EXPECT_EQ(drive->frames_without_odometry, 5U);
  EXPECT_EQ(drive->frames.front().stamp_s, 2.0);
}

TEST_F(RunLogPlayerTest, NoFrameWithOdometryIsAnError) {
  FakeScoreSource source;
  Localizer robot = localizer(source);
  const auto drive = play(log_with({{100.0, {}}, {101.0, {}}}), PanoramaCamera{}, robot);
  ASSERT_FALSE(drive);
  EXPECT_EQ(drive.error().code, ErrorCode::kInvalidArgument);
}

TEST_F(RunLogPlayerTest, FrameWithoutLabelsIsDeadReckoning) {
  FakeScoreSource source;
  source.reach_m = 20.0;
  Localizer robot = localizer(source);
  io::RunLog log = log_with(odometry_);
  log.frames[4].labels.clear();
  const auto drive = play(log, PanoramaCamera{}, robot);
  ASSERT_TRUE(drive);
  EXPECT_EQ(drive->frames[4].state, FrameState::kUnseen);
  EXPECT_EQ(drive->frames[5].state, FrameState::kScored);
}

TEST_F(RunLogPlayerTest, ErrorsSayInWhichFrame) {
  FakeScoreSource source;
  source.broken = Error{ErrorCode::kFailedPrecondition, "another building"};
  Localizer robot = localizer(source);
  const auto drive = play(log_with(odometry_), PanoramaCamera{}, robot);
  ASSERT_FALSE(drive);
  EXPECT_EQ(drive.error().message, "frame 1 of 10: another building");
}

}  // namespace
}  // namespace semview::robot
