// SPDX-License-Identifier: Apache-2.0
// Every shipped map is one that a simulated robot can be localized in, with the map's own weights.
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/geometry/angle.hpp"
#include "semview/io/trajectory.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace semview {
namespace {

using semview::testing::Outcome;
using semview::testing::run_semview;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kMaps = SEMVIEW_SOURCE_DIR "/maps/";

class ShippedWeightsLocalizeTest : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// A short drive seen by a small camera; writes the run log `log`.
  void simulate(const std::string& arguments) const {
    const Outcome run = run_semview("simulate " + arguments + " --out " + file("log") +
                                    " --steps 3 --columns 120 --rows 30");
    ASSERT_EQ(run.exit_code, 0) << run.output;
  }

  Outcome localize(const std::string& arguments) const {
    const Pose2 start = io::read_tum(file("log") + "/groundtruth.txt")->front().pose;
    return run_semview(fmt::format(
        "localize --log {} --init {:.3f},{:.3f},{:.1f},0.1 --particles 20 --threads 1 -o {} {}",
        file("log"),
        start.x_m,
        start.y_m,
        deg_from_rad(start.yaw_rad),
        file("est.tum"),
        arguments));
  }

  semview::testing::TemporaryFolder folder_;
};

TEST_F(ShippedWeightsLocalizeTest, EveryMapLocalizesItsSimulatedRobotWithItsOwnWeights) {
  int maps = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kMaps)) {
    const std::string map = entry.path().string();
    if (!std::filesystem::exists(entry.path() / "map.yaml")) continue;
    ++maps;
    std::filesystem::remove_all(file("log"));
    simulate(map);
    for (const std::string& weights : {std::string(), " --weights " + map + "/weights.csv"}) {
      const Outcome run = localize("--map " + map + weights);
      EXPECT_EQ(run.exit_code, 0) << run.output;
      EXPECT_THAT(run.output, HasSubstr("3 frames, 3 scored"));
      EXPECT_THAT(run.output, Not(HasSubstr("identity"))) << map;
    }
  }
  EXPECT_GE(maps, 5);
}

TEST_F(ShippedWeightsLocalizeTest, ADriveInAnotherWorldNeedsAMatrixThatTheHintTellsHowToMake) {
  simulate(kMaps + "duplex_level1 --world " + kMaps + "duplex_building");
  const std::string map = "--map " + kMaps + "duplex_level1";
  const Outcome refused = localize(map);
  EXPECT_NE(refused.exit_code, 0);
  EXPECT_THAT(refused.output, HasSubstr("no row for observed class"));
  EXPECT_THAT(refused.output, HasSubstr("semview weights init MAP --vocabulary V -o w.csv"));

  const Outcome init = run_semview("weights init " + kMaps + "duplex_level1 --vocabulary " +
                                   file("log") + " -o " + file("w.csv"));
  ASSERT_EQ(init.exit_code, 0) << init.output;
  const Outcome run = localize(map + " --weights " + file("w.csv"));
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("3 frames, 3 scored"));
}

TEST_F(ShippedWeightsLocalizeTest, AMapWithoutWeightsIsLocalizedByEqualNamesAndAWarningSaysSo) {
  std::filesystem::create_directories(file("bare"));
  for (const char* name : {"map.yaml", "labels.png"}) {
    std::filesystem::copy_file(kMaps + "tutorial/" + name, file("bare/") + name);
  }
  simulate(file("bare"));
  const Outcome by_itself = localize("--map " + file("bare"));
  EXPECT_EQ(by_itself.exit_code, 0) << by_itself.output;
  EXPECT_THAT(by_itself.output,
              HasSubstr("weights: identity (only equal names score), for the map "
                        "has no weights.csv"));

  std::ofstream(file("bare/weights.csv")) << "observed,wall,none\nwall,1,0\n";
  const Outcome misfit = localize("--map " + file("bare"));
  EXPECT_EQ(misfit.exit_code, 0) << misfit.output;
  EXPECT_THAT(misfit.output, HasSubstr("weights.csv: weights: no row for observed class"));
}

TEST_F(ShippedWeightsLocalizeTest, IdentityMayBeAskedForWhateverTheClasses) {
  simulate(kMaps + "duplex_level1 --world " + kMaps + "duplex_building");
  const std::string map = kMaps + "duplex_level1";
  const Outcome run = localize("--map " + map + " --weights identity");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("weights: identity"));

  const Pose2 start = io::read_tum(file("log") + "/groundtruth.txt")->front().pose;
  const std::string frame = map + " --obs " + file("log") + " --frame 0 --weights identity";
  const Outcome score =
      run_semview(fmt::format("score {} --pose {:.3f},{:.3f},0", frame, start.x_m, start.y_m));
  EXPECT_EQ(score.exit_code, 0) << score.output;
  const Outcome heat = run_semview("heatmap " + frame +
                                   " --columns 120 --rows 30 --headings 4 -o " + file("heat.png"));
  EXPECT_EQ(heat.exit_code, 0) << heat.output;
}

}  // namespace
}  // namespace semview
