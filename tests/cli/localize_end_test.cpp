// SPDX-License-Identifier: Apache-2.0
// What a run of `semview localize` leaves behind when it does not go as planned.
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/geometry/angle.hpp"
#include "semview/io/trajectory.hpp"
#include "support/running_server.hpp"
#include "support/semview_runs.hpp"

namespace semview {
namespace {

using semview::testing::Arguments;
using semview::testing::ChildProcess;
using semview::testing::RunningServer;
using ::testing::HasSubstr;

const std::string kMap = SEMVIEW_SOURCE_DIR "/maps/duplex_level1";

class LocalizeEndTest : public semview::testing::SemviewRuns {
 protected:
  void SetUp() override {
    ASSERT_EQ(run({"simulate", kMap, "--out", file("log"), "--steps", "6"}), 0) << errors_;
  }

  /// From the true start, with `more`; writes est.tum.
  Arguments localize(const Arguments& more) const {
    const Pose2 start = io::read_tum(file("log/groundtruth.txt"))->front().pose;
    const std::string init =
        fmt::format("{:.3f},{:.3f},{:.1f},0.1", start.x_m, start.y_m, deg_from_rad(start.yaw_rad));
    Arguments all{"localize", "--log", file("log"), "--init", init, "--particles", "20"};
    all.insert(all.end(), {"-o", file("est.tum")});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  std::size_t estimates() const {
    const auto track = io::read_tum(file("est.tum"));
    return track ? track->size() : 0;
  }
};

TEST_F(LocalizeEndTest, ADistortionTakesCombinedHeadingsAndMoreParticlesUnlessToldOtherwise) {
  ASSERT_EQ(run({"simulate", kMap, "--out", file("short"), "--steps", "2"}), 0) << errors_;
  const Pose2 start = io::read_tum(file("short/groundtruth.txt"))->front().pose;
  const std::string init =
      fmt::format("{:.3f},{:.3f},{:.1f},0.1", start.x_m, start.y_m, deg_from_rad(start.yaw_rad));
  const auto bytes = [&](const Arguments& more) {
    Arguments all{"localize",
                  "--log",
                  file("short"),
                  "--map",
                  kMap,
                  "--init",
                  init,
                  "-o",
                  file("est.tum"),
                  "--columns",  // coarse: each of 2000 particles has a view of its own cast
                  "120",
                  "--rows",
                  "30",
                  "--estimate-map-affine"};
    all.insert(all.end(), more.begin(), more.end());
    EXPECT_EQ(run(all), 0) << errors_;
    return semview::testing::file_bytes(file("est.particles.csv"));
  };
  const std::string usual = bytes({});
  EXPECT_EQ(bytes({"--heading", "combined", "--particles", "2000"}), usual);
  EXPECT_NE(bytes({"--heading", "odometry"}), usual);
}

TEST_F(LocalizeEndTest, FramesWithoutOdometryAreToldInTheSummary) {
  auto odometry = io::read_tum(file("log/odometry.txt")).value();
  const auto truth = io::read_tum(file("log/groundtruth.txt")).value();
  odometry.resize(odometry.size() / 2);
  ASSERT_TRUE(io::write_tum(file("log/odometry.txt"), odometry));
  ASSERT_EQ(run(localize({"--map", kMap})), 0) << errors_;
  ASSERT_LT(estimates(), 6U);
  EXPECT_THAT(output_,
              HasSubstr(fmt::format(", {} more left out, without odometry", 6U - estimates())));
}

TEST_F(LocalizeEndTest, AnErrorAfterSomeFramesKeepsTheirEstimates) {
  folder_.write("log/labels/000002.png", "no picture");
  EXPECT_EQ(run(localize({"--map", kMap})), 1);
  EXPECT_THAT(errors_, HasSubstr("000002.png: is not a PNG file"));
  EXPECT_THAT(errors_, HasSubstr("est.tum: has the estimates of the 2 frames before it"));
  EXPECT_EQ(estimates(), 2U);
  const std::string frames = semview::testing::file_bytes(file("est.frames.csv"));
  EXPECT_EQ(std::ranges::count(frames, '\n'), 3);
  EXPECT_TRUE(std::filesystem::exists(file("est.particles.csv")));
}

TEST_F(LocalizeEndTest, AnInterruptAfterSomeFramesKeepsTheirEstimates) {
  RunningServer server({"--map", kMap, "--bind", "tcp://127.0.0.1:*"}, folder_ / "server");
  const Arguments remote{"--server", server.endpoint(), "--map", "duplex_level1"};
  Arguments arguments = localize(remote);
  // A frame in two seconds: the log lasts longer than the test.
  arguments.insert(arguments.end(), {"--rate", "0.5", "--timeout", "0.5"});
  ChildProcess robot("semview", arguments, folder_ / "robot");
  ASSERT_TRUE(robot.says("localizing")) << robot.errors();
  server.signal(SIGKILL);
  ASSERT_TRUE(robot.says("going on by odometry")) << robot.errors();
  robot.signal(SIGINT);
  EXPECT_EQ(robot.wait(), 1) << robot.errors();
  EXPECT_THAT(robot.errors(), HasSubstr("stopped before frame"));
  EXPECT_THAT(robot.errors(), HasSubstr("est.tum: has the estimates of the"));
  EXPECT_GE(estimates(), 1U);
}

}  // namespace
}  // namespace semview
