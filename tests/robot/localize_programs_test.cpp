// SPDX-License-Identifier: Apache-2.0
// The built programs on a real floor: simulate, localize in-process and with a server.
#include <cmath>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "semview/geometry/angle.hpp"
#include "semview/io/trajectory.hpp"
#include "support/running_server.hpp"
#include "support/temporary_folder.hpp"

namespace semview {
namespace {

using semview::testing::ChildProcess;
using semview::testing::RunningServer;
using Arguments = std::vector<std::string>;

const std::string kMap = std::string(SEMVIEW_SOURCE_DIR) + "/maps/duplex_level1";

/// A simulated drive on disk.
struct Drive {
  std::string log;
  std::vector<io::StampedPose2> truth;
  std::vector<io::StampedPose2> odometry;

  /// --init at the first pose, 0.3 m uncertain, rounded as demo.sh rounds it.
  std::string known_start() const {
    const Pose2& pose = truth.front().pose;
    return fmt::format("{:.3f},{:.3f},{:.1f},0.3", pose.x_m, pose.y_m, deg_from_rad(pose.yaw_rad));
  }
};

struct Ends {
  double estimate_m = 0.0;
  double odometry_m = 0.0;
};

/// How far off the last pose of an estimate is, and odometry laid onto the true start.
Ends ends(const Drive& drive, const std::string& estimate) {
  const io::StampedPose2 last = io::read_tum(estimate)->back();
  const Pose2 truth = *io::interpolate(drive.truth, last.stamp_s);
  const Pose2 odometry =
      drive.truth.front().pose *
      (inverse(drive.odometry.front().pose) * *io::interpolate(drive.odometry, last.stamp_s));
  return {distance_m(last.pose, truth), distance_m(odometry, truth)};
}

class LocalizeProgramsTest : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  int run(const std::string& program, const Arguments& arguments) {
    ChildProcess process(program, arguments, folder_ / "last");
    const int code = process.wait();
    last_errors_ = process.errors();
    return code;
  }

  Drive simulate(const std::string& name, int seed, int frames) {
    Drive drive{file(name), {}, {}};
    EXPECT_EQ(run("semview",
                  {"simulate",
                   kMap,
                   "--out",
                   drive.log,
                   "--seed",
                   std::to_string(seed),
                   "--steps",
                   std::to_string(frames)}),
              0)
        << last_errors_;
    drive.truth = *io::read_tum(drive.log + "/groundtruth.txt");
    drive.odometry = *io::read_tum(drive.log + "/odometry.txt");
    return drive;
  }

  std::unique_ptr<RunningServer> serve(const std::string& endpoint = "tcp://127.0.0.1:*") const {
    return std::make_unique<RunningServer>(
        Arguments{"--map", kMap, "--bind", endpoint, "--cache", file("cache")}, folder_ / "server");
  }

  /// A robot as demo.sh starts it; it writes `drive.log`.est.tum.
  static std::unique_ptr<ChildProcess> localize(const Drive& drive,
                                                std::size_t seed,
                                                const RunningServer& server,
                                                const std::string& heading) {
    return std::make_unique<ChildProcess>("semview",
                                          Arguments{"localize",
                                                    "--log",
                                                    drive.log,
                                                    "--server",
                                                    server.endpoint(),
                                                    "--map",
                                                    "duplex_level1",
                                                    "--weights",
                                                    kMap + "/weights.csv",
                                                    "--init",
                                                    drive.known_start(),
                                                    "--seed",
                                                    std::to_string(seed),
                                                    "--heading",
                                                    heading,
                                                    "-o",
                                                    drive.log + ".est.tum"},
                                          drive.log);
  }

  semview::testing::TemporaryFolder folder_;
  std::string last_errors_;
};

TEST_F(LocalizeProgramsTest, InProcessAndRemoteWriteTheSameBytesForAnyNumberOfThreads) {
  const Drive drive = simulate("log", 1, 8);
  const auto server = serve();
  for (const char* heading : {"odometry", "compass", "combined"}) {
    for (const char* start : {"known", "sampled", "dense"}) {
      Arguments common{"localize", "--log", drive.log, "--seed", "7", "--heading", heading};
      common.insert(common.end(), {"--particles", "300", "--timeout", "60"});
      if (start == std::string("known")) {
        common.insert(common.end(), {"--init", drive.known_start()});
      } else {
        common.insert(common.end(), {"--global", start});
      }
      Arguments remote = common;
      remote.insert(
          remote.end(),
          {"--server", server->endpoint(), "--map", "duplex_level1", "-o", file("remote.tum")});
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

TEST_F(LocalizeProgramsTest, WhatIsBeyondThePapersHasTheSameBytesRemoteToo) {
  const Drive drive = simulate("log", 1, 5);
  const auto server = serve();
  const Arguments common{"localize",
                         "--log",
                         drive.log,
                         "--seed",
                         "7",
                         "--init",
                         drive.known_start(),
                         "--heading",
                         "combined",
                         "--estimate-map-affine",
                         "--affine-drift",
                         "0.01",
                         "--kld",
                         "--recovery",
                         "uniform",
                         "--refine",
                         "--particles",
                         "200",
                         "--json"};
  const auto bytes = [&](Arguments more) {
    more.insert(more.begin(), common.begin(), common.end());
    more.insert(more.end(), {"-o", file("est.tum")});
    EXPECT_EQ(run("semview", more), 0) << last_errors_;
    return semview::testing::file_bytes(file("est.tum")) +
           semview::testing::file_bytes(file("est.particles.csv"));
  };
  const std::string here = bytes({"--map", kMap});
  const std::string frames = semview::testing::file_bytes(file("est.frames.csv"));
  EXPECT_NE(frames.find("lost_probability,scale_x,"), std::string::npos);
  EXPECT_EQ(frames.find(",,,,,"), std::string::npos) << "every frame tells of the map";
  EXPECT_EQ(bytes({"--server", server->endpoint(), "--map", "duplex_level1", "--timeout", "60"}),
            here);
}

TEST_F(LocalizeProgramsTest, ServerThatGoesAwayLeavesAStaleStretchAndTheRunRecovers) {
  const Drive drive = simulate("log", 1, 40);
  auto server = serve();
  const std::string endpoint = server->endpoint();
  // 40 seconds of log: there is time to lose the server and to find it again.
  ChildProcess localize("semview",
                        {"localize",
                         "--log",
                         drive.log,
                         "--server",
                         endpoint,
                         "--map",
                         "duplex_level1",
                         "--init",
                         drive.known_start(),
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
  server = serve(endpoint);
  ASSERT_TRUE(localize.says("scored again")) << localize.errors();
  ASSERT_EQ(localize.wait(), 0) << localize.errors();
  const std::string frames = semview::testing::file_bytes(file("est.frames.csv"));
  EXPECT_NE(frames.find(",stale,"), std::string::npos);
  EXPECT_LT(ends(drive, file("est.tum")).estimate_m, 0.3);
}

/// What demo.sh does with seeds 1 and 2, and exits by; the compass, too.
TEST_F(LocalizeProgramsTest, TenSeedsInPairsEndNearTheTruthAndNearerThanTheirOdometry) {
  constexpr int kFrames = 60;
  std::vector<Drive> drives;
  for (int seed = 1; seed <= 10; ++seed) {
    drives.push_back(simulate("robot" + std::to_string(seed), seed, kFrames));
  }
  const auto server = serve();
  for (const std::string heading : {"odometry", "compass"}) {
    for (std::size_t first = 0; first < drives.size(); first += 2) {
      const auto one = localize(drives[first], first + 1, *server, heading);
      const auto other = localize(drives[first + 1], first + 2, *server, heading);
      ASSERT_EQ(one->wait(), 0) << one->errors();
      ASSERT_EQ(other->wait(), 0) << other->errors();
      for (const Drive& drive : {drives[first], drives[first + 1]}) {
        const Ends end = ends(drive, drive.log + ".est.tum");
        EXPECT_LT(end.estimate_m, 0.3) << heading << ", " << drive.log;
        EXPECT_LT(end.estimate_m, end.odometry_m) << heading << ", " << drive.log;
      }
    }
  }
}

TEST_F(LocalizeProgramsTest, WrongUsageIsTwoAndAFailureIsOneLine) {
  const Drive drive = simulate("log", 1, 2);
  const Arguments common{"localize", "--log", drive.log, "--map", kMap, "-o", file("est.tum")};
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
