// SPDX-License-Identifier: Apache-2.0
// The built programs on a real floor: simulate, localize in-process and with a server.
#include <cmath>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "semview/geometry/angle.hpp"
#include "semview/io/trajectory.hpp"
#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace semview {
namespace {

using semview::testing::ChildProcess;
using Arguments = std::vector<std::string>;

const std::string kMap = std::string(SEMVIEW_SOURCE_DIR) + "/maps/duplex_level1";

struct Ends {
  double estimate_m = 0.0;
  double odometry_m = 0.0;
};

class LocalizeProgramsTest : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  int run(const std::string& program, const Arguments& arguments) {
    ChildProcess process(program, arguments, folder_ / "last");
    const int code = process.wait();
    last_output_ = process.output();
    last_errors_ = process.errors();
    return code;
  }

  void simulate(const std::string& log, int seed, int steps) {
    ASSERT_EQ(run("semview",
                  {"simulate",
                   kMap,
                   "--out",
                   file(log),
                   "--seed",
                   std::to_string(seed),
                   "--steps",
                   std::to_string(steps)}),
              0)
        << last_errors_;
    truth_ = *io::read_tum(folder_ / (log + "/groundtruth.txt"));
    odometry_ = *io::read_tum(folder_ / (log + "/odometry.txt"));
  }

  /// --init at the log's first pose, 0.3 m uncertain.
  std::string known_start() const {
    const Pose2& pose = truth_.front().pose;
    return std::to_string(pose.x_m) + "," + std::to_string(pose.y_m) + "," +
           std::to_string(deg_from_rad(pose.yaw_rad)) + ",0.3";
  }

  /// How far off the last pose of an estimate is, and odometry laid onto the true start.
  Ends ends(const std::string& estimate) const {
    const io::StampedPose2 last = io::read_tum(folder_ / estimate)->back();
    const Pose2 truth = *io::interpolate(truth_, last.stamp_s);
    const Pose2 odometry = truth_.front().pose * (inverse(odometry_.front().pose) *
                                                  *io::interpolate(odometry_, last.stamp_s));
    return {distance_m(last.pose, truth), distance_m(odometry, truth)};
  }

  /// A server of the map on `endpoint`; port 0 takes a free one. Sets `endpoint_`.
  std::unique_ptr<ChildProcess> serve(const std::string& endpoint) {
    auto server = std::make_unique<ChildProcess>(
        "semview-server",
        Arguments{"--map", kMap, "--bind", endpoint, "--cache", file("cache")},
        folder_ / "server");
    EXPECT_TRUE(server->says("listening on tcp://")) << server->errors();
    const std::string text = server->output();
    const std::size_t begin = text.find("tcp://");
    endpoint_ = text.substr(begin, text.find('\n', begin) - begin);
    return server;
  }

  semview::testing::TemporaryFolder folder_;
  std::vector<io::StampedPose2> truth_;
  std::vector<io::StampedPose2> odometry_;
  std::string endpoint_;
  std::string last_output_;
  std::string last_errors_;
};

TEST_F(LocalizeProgramsTest, InProcessAndRemoteWriteTheSameBytesForAnyNumberOfThreads) {
  simulate("log", 1, 8);
  const auto server = serve("tcp://127.0.0.1:0");
  for (const char* heading : {"odometry", "compass"}) {
    for (const bool global : {false, true}) {
      Arguments common{"localize", "--log", file("log"), "--seed", "7", "--heading", heading};
      common.insert(common.end(), {"--particles", "300", "--timeout", "60"});
      if (global) {
        common.emplace_back("--global");
      } else {
        common.insert(common.end(), {"--init", known_start()});
      }
      Arguments remote = common;
      remote.insert(remote.end(),
                    {"--server", endpoint_, "--map", "duplex_level1", "-o", file("remote.tum")});
      ASSERT_EQ(run("semview", remote), 0) << last_errors_;
      for (const char* threads : {"1", "3"}) {
        Arguments local = common;
        local.insert(local.end(), {"--map", kMap, "--threads", threads, "-o", file("local.tum")});
        ASSERT_EQ(run("semview", local), 0) << last_errors_;
        for (const std::string end : {".tum", ".particles.csv"}) {
          const std::string bytes = semview::testing::file_bytes(file("local" + end));
          EXPECT_FALSE(bytes.empty());
          EXPECT_EQ(bytes, semview::testing::file_bytes(file("remote" + end))) << heading << end;
        }
      }
    }
  }
}

TEST_F(LocalizeProgramsTest, ServerThatGoesAwayLeavesAStaleStretchAndTheRunRecovers) {
  simulate("log", 1, 40);
  auto server = serve("tcp://127.0.0.1:0");
  // 40 seconds of log: there is time to lose the server and to find it again.
  ChildProcess localize("semview",
                        {"localize",
                         "--log",
                         file("log"),
                         "--server",
                         endpoint_,
                         "--map",
                         "duplex_level1",
                         "--init",
                         known_start(),
                         "--rate",
                         "2",
                         "--timeout",
                         "1",
                         "-o",
                         file("est.tum")},
                        folder_ / "localize");
  ASSERT_TRUE(localize.says("localizing")) << localize.errors();
  server->signal(SIGKILL);
  server->wait();
  ASSERT_TRUE(localize.says("going on by odometry")) << localize.errors();
  server = serve(endpoint_);
  ASSERT_TRUE(localize.says("scored again")) << localize.errors();
  ASSERT_EQ(localize.wait(), 0) << localize.errors();
  const std::string frames = semview::testing::file_bytes(file("est.frames.csv"));
  EXPECT_NE(frames.find(",stale,"), std::string::npos);
  EXPECT_LT(ends("est.tum").estimate_m, 0.3);
}

TEST_F(LocalizeProgramsTest, TenSeedsEndNearTheTruthAndNearerThanTheirOdometry) {
  for (const char* heading : {"odometry", "compass"}) {
    for (int seed = 1; seed <= 10; ++seed) {
      const std::string log = "log" + std::to_string(seed);
      if (!std::filesystem::exists(file(log))) {
        simulate(log, seed, 30);
      } else {
        truth_ = *io::read_tum(folder_ / (log + "/groundtruth.txt"));
        odometry_ = *io::read_tum(folder_ / (log + "/odometry.txt"));
      }
      ASSERT_EQ(run("semview",
                    {"localize",
                     "--log",
                     file(log),
                     "--map",
                     kMap,
                     "--cache",
                     file("cache"),
                     "--init",
                     known_start(),
                     "--heading",
                     heading,
                     "-o",
                     file("est.tum")}),
                0)
          << last_errors_;
      const Ends end = ends("est.tum");
      EXPECT_LT(end.estimate_m, 0.3) << heading << ", seed " << seed;
      EXPECT_LT(end.estimate_m, end.odometry_m) << heading << ", seed " << seed;
    }
  }
}

TEST_F(LocalizeProgramsTest, WrongUsageIsTwoAndAFailureIsOneLine) {
  simulate("log", 1, 2);
  const Arguments common{"localize", "--log", file("log"), "--map", kMap, "-o", file("est.tum")};
  const auto with = [&common](const Arguments& more) {
    Arguments all = common;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  EXPECT_EQ(run("semview", common), 2);
  EXPECT_NE(last_errors_.find("--global"), std::string::npos) << last_errors_;
  EXPECT_EQ(run("semview", with({"--init", "1,2"})), 2);
  EXPECT_EQ(run("semview", with({"--global", "--power", "-1"})), 2);
  EXPECT_NE(last_errors_.find("--power"), std::string::npos) << last_errors_;
  EXPECT_EQ(run("semview", with({"--global", "--compass-gain", "2"})), 2);
  EXPECT_NE(last_errors_.find("--compass-gain"), std::string::npos) << last_errors_;
  EXPECT_EQ(
      run("semview", with({"--global", "--server", "tcp://127.0.0.1:1", "--cache", file("cache")})),
      2);
  EXPECT_EQ(run("semview", with({"--global", "--server", "tcp://127.0.0.1:1", "--timeout", "0.2"})),
            1);
  EXPECT_EQ(run("semview", with({"--global", "--weights", file("no.csv")})), 1);
  EXPECT_FALSE(std::filesystem::exists(file("est.tum")));
}

}  // namespace
}  // namespace semview
