// SPDX-License-Identifier: Apache-2.0
// The built programs together: simulated robots on a real floor, localized in-process and by a
// server that comes and goes.
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "semview/geometry/angle.hpp"
#include "semview/io/trajectory.hpp"
#include "support/paths.hpp"
#include "support/program.hpp"
#include "support/temporary_folder.hpp"

namespace semview {
namespace {

using testing::endpoint_of;
using testing::Program;

class LocalizeTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  void simulate(const std::string& log, int seed, const std::string& frames) const {
    ASSERT_EQ(testing::run("semview",
                           {"simulate",
                            kMap,
                            "--out",
                            path(log),
                            "--seed",
                            std::to_string(seed),
                            "--steps",
                            frames},
                           path(log + ".simulate")),
              0)
        << Program::read(path(log + ".simulate.err"));
  }

  /// `--init` of a robot that knows where its drive starts, give or take 0.3 m.
  std::string start_of(const std::string& log) const {
    const auto truth = io::read_tum(path(log) + "/groundtruth.txt");
    if (!truth) return {};
    const Pose2& pose = truth->front().pose;
    return fmt::format("{},{},{},0.3", pose.x_m, pose.y_m, deg_from_rad(pose.yaw_rad));
  }

  /// Starts `semview localize` for a log, with an output of its own name.
  std::unique_ptr<Program> localize(const std::string& log,
                                    const std::string& name,
                                    std::vector<std::string> more) const {
    std::vector<std::string> arguments{"localize",
                                       "--log",
                                       path(log),
                                       "--weights",
                                       kMap + "/weights.csv",
                                       "--init",
                                       start_of(log),
                                       "-o",
                                       path(name + ".tum")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return std::make_unique<Program>("semview", arguments, path(name));
  }

  std::unique_ptr<Program> serve(const std::string& endpoint) const {
    return std::make_unique<Program>(
        "semview-server",
        std::vector<std::string>{
            "--map", kMap, "--bind", endpoint, "--cache", path("cache"), "--threads", "2"},
        path("server"));
  }

  /// Lines of a frames report in the state.
  int frames_in_state(const std::string& name, const std::string& state) const {
    const std::string report = Program::read(path(name + ".frames.csv"));
    int count = 0;
    for (std::size_t at = report.find("," + state + ","); at != std::string::npos;
         at = report.find("," + state + ",", at + 1)) {
      ++count;
    }
    return count;
  }

  static inline const std::string kMap = std::string(SEMVIEW_SOURCE_DIR) + "/maps/duplex_level1";
  testing::TemporaryFolder folder_;
};

// The claim of the demo, for ten robots: every one ends nearer to the truth than its odometry, and
// within 0.3 m. The default filter ends 0.003 to 0.11 m off for these; of the seeds 1 to 20 one
// drives out onto the open terrace, where little tells places apart, and ends 0.29 m off.
TEST_F(LocalizeTest, TenOfTenRobotsEndWithinThirtyCentimetres) {
  for (int seed = 11; seed <= 20; ++seed) {
    const std::string log = "robot" + std::to_string(seed);
    simulate(log, seed, "30");
    const auto robot = localize(
        log, "est", {"--map", kMap, "--cache", path("cache"), "--seed", std::to_string(seed)});
    ASSERT_EQ(robot->wait(), 0) << robot->err();
    EXPECT_EQ(testing::run(
                  "semview",
                  {"evaluate", "run", "--log", path(log), path("est.tum"), "--final-within", "0.3"},
                  path("evaluate")),
              0)
        << "seed " << seed << ": " << Program::read(path("evaluate.err"))
        << Program::read(path("evaluate.out"));
  }
}

TEST_F(LocalizeTest, ThreeRobotsAtOnceGetFromTheServerWhatTheyGetInProcess) {
  for (int seed = 1; seed <= 3; ++seed) simulate("robot" + std::to_string(seed), seed, "6");
  const auto server = serve("tcp://127.0.0.1:*");
  const std::string endpoint = endpoint_of(*server);
  ASSERT_FALSE(endpoint.empty()) << server->err();
  std::vector<std::unique_ptr<Program>> robots;
  for (int seed = 1; seed <= 3; ++seed) {
    const std::string name = std::to_string(seed);
    robots.push_back(localize("robot" + name,
                              "remote" + name,
                              {"--server", endpoint, "--map", "duplex_level1", "--seed", name}));
  }
  for (int seed = 1; seed <= 3; ++seed) {
    const std::string name = std::to_string(seed);
    ASSERT_EQ(robots[static_cast<std::size_t>(seed) - 1]->wait(), 0)
        << robots[static_cast<std::size_t>(seed) - 1]->err();
    for (const std::string threads : {"1", "2"}) {
      const auto local = localize(
          "robot" + name, "local" + name, {"--map", kMap, "--seed", name, "--threads", threads});
      ASSERT_EQ(local->wait(), 0) << local->err();
      EXPECT_EQ(Program::read(path("remote" + name + ".tum")),
                Program::read(path("local" + name + ".tum")));
    }
  }
  server->signal(SIGTERM);
  EXPECT_EQ(server->wait(), 0) << server->err();
}

TEST_F(LocalizeTest, ARobotGoesOnByOdometryWhileTheServerIsGoneAndRecovers) {
  simulate("robot", 1, "24");
  auto server = serve("tcp://127.0.0.1:*");
  const std::string endpoint = endpoint_of(*server);
  ASSERT_FALSE(endpoint.empty()) << server->err();
  const auto robot =
      localize("robot",
               "est",
               {"--server", endpoint, "--map", "duplex_level1", "--rate", "2", "--timeout", "2"});
  std::this_thread::sleep_for(std::chrono::milliseconds(4000));
  server->signal(SIGKILL);
  server->wait();
  std::this_thread::sleep_for(std::chrono::milliseconds(3000));
  server = serve(endpoint);
  ASSERT_EQ(endpoint_of(*server), endpoint) << server->err();
  ASSERT_EQ(robot->wait(), 0) << robot->err();

  EXPECT_GT(frames_in_state("est", "stale"), 0);
  EXPECT_GT(frames_in_state("est", "scored"), 0);
  const std::string report = Program::read(path("est.frames.csv"));
  EXPECT_GT(report.rfind(",scored,"), report.rfind(",stale,")) << "never recovered:\n" << report;
  const auto estimate = io::read_tum(path("est.tum"));
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->size(), 24U);
}

}  // namespace
}  // namespace semview
