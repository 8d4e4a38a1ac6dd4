// SPDX-License-Identifier: Apache-2.0
// `semview simulate` as a person or script calls it.
#include <filesystem>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "semview/io/png.hpp"
#include "semview/io/run_log.hpp"
#include "support/paths.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace semview {
namespace {

using semview::testing::file_bytes;
using semview::testing::Outcome;
using semview::testing::run_semview;
using ::testing::HasSubstr;

const std::string kMap = SEMVIEW_SOURCE_DIR "/maps/tutorial";

class SimulateProgramTest : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  Outcome simulate(const std::string& out, const std::string& options) const {
    return run_semview("simulate " + kMap + " --out " + file(out) + " --steps 4 " + options);
  }

  /// Relative names of the files below `out`.
  std::set<std::string> files(const std::string& out) const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / out)) {
      if (!entry.is_directory()) {
        names.insert(std::filesystem::relative(entry.path(), folder_ / out).string());
      }
    }
    return names;
  }

  testing::TemporaryFolder folder_;
};

TEST_F(SimulateProgramTest, WritesARunLogAndSaysWhereTheRobotStarts) {
  const Outcome outcome = simulate("log", "--seed 5 --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(files("log"),
            (std::set<std::string>{"log.yaml",
                                   "frames.csv",
                                   "odometry.txt",
                                   "groundtruth.txt",
                                   "labels/000000.png",
                                   "labels/000001.png",
                                   "labels/000002.png",
                                   "labels/000003.png"}));
  const auto log = io::read_run_log(folder_ / "log");
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(log->frames.size(), 4U);
  const nlohmann::json report = nlohmann::json::parse(outcome.answer);
  EXPECT_EQ(report["frames"], 4);
  EXPECT_EQ(report["seed"], 5);
  ASSERT_TRUE(log->groundtruth);
  const Pose2 start = log->groundtruth->front().pose;
  EXPECT_NEAR(report["start"]["x_m"].get<double>(), start.x_m, 0.05);
  EXPECT_NEAR(report["start"]["y_m"].get<double>(), start.y_m, 0.05);
  EXPECT_EQ(io::read_png_grey(folder_ / "log" / "labels/000003.png").value().columns(), 720);
}

TEST_F(SimulateProgramTest, WritesTheSameFilesForTheSameSeedAndOthersForAnother) {
  ASSERT_EQ(simulate("a", "--seed 5").exit_code, 0);
  ASSERT_EQ(simulate("b", "--seed 5").exit_code, 0);
  ASSERT_EQ(simulate("c", "--seed 6").exit_code, 0);
  for (const std::string& name : files("a")) {
    EXPECT_EQ(file_bytes(folder_ / "a" / name), file_bytes(folder_ / "b" / name)) << name;
  }
  EXPECT_NE(file_bytes(folder_ / "a" / "groundtruth.txt"),
            file_bytes(folder_ / "c" / "groundtruth.txt"));
}

TEST_F(SimulateProgramTest, LeavesARunLogThatIsThereAsItIs) {
  ASSERT_EQ(simulate("log", "--seed 5").exit_code, 0);
  const std::string before = file_bytes(folder_ / "log" / "groundtruth.txt");
  const Outcome again = simulate("log", "--seed 6");
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_THAT(again.output, HasSubstr(file("log") + ": holds a run log already"));
  EXPECT_EQ(file_bytes(folder_ / "log" / "groundtruth.txt"), before);
}

TEST_F(SimulateProgramTest, ExitsWith2ForAnOptionThatItCannotRead) {
  EXPECT_EQ(run_semview("simulate").exit_code, 2);
  EXPECT_EQ(run_semview("simulate " + kMap).exit_code, 2);
  EXPECT_EQ(simulate("log", "--no-such-option").exit_code, 2);
  EXPECT_EQ(simulate("log", "--seed one").exit_code, 2);
  const Outcome outcome = simulate("log", "--elevation 5");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("--elevation 5: expected 2"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "log"));
}

TEST_F(SimulateProgramTest, NamesTheValueThatIsOutOfItsRangeAndWritesNothing) {
  for (const auto& [options, message] :
       {std::pair{"--noise 9", "9 is not in [0, 5]"},
        std::pair{"--columns 100", "100 must be a multiple of 120"},
        std::pair{"--fov 400", "400 is not in (0, 360]"},
        std::pair{"--world /nowhere", "/nowhere: no such file"}}) {
    const Outcome outcome = simulate("log", options);
    EXPECT_NE(outcome.exit_code, 0) << options;
    EXPECT_THAT(outcome.output, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "log")) << options;
  }
}

}  // namespace
}  // namespace semview
