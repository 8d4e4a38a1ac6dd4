// SPDX-License-Identifier: Apache-2.0
// `semview weights learn` and `show`: what they leave, and what they say of pictures that teach
// nothing.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "semview/io/png.hpp"
#include "semview/io/trajectory.hpp"
#include "support/paths.hpp"
#include "support/semview_runs.hpp"

namespace semview {
namespace {

using ::testing::HasSubstr;

const std::string kMap = SEMVIEW_SOURCE_DIR "/maps/tutorial";

class WeightsVerbsTest : public semview::testing::SemviewRuns {
 protected:
  void simulate() {
    ASSERT_EQ(run({"simulate", kMap, "--out", file("run"), "--steps", "4"}), 0) << errors_;
  }
  /// Moves the ground truth of the poses from `first` on.
  void carry_off(std::size_t first) {
    auto truth = io::read_tum(file("run/groundtruth.txt")).value();
    for (std::size_t i = first; i < truth.size(); ++i) truth[i].pose.x_m += 1000.0;
    ASSERT_TRUE(io::write_tum(file("run/groundtruth.txt"), truth));
  }
  int learn() {
    return run({"weights",
                "learn",
                kMap,
                file("run"),
                "--columns",
                "120",
                "--rows",
                "30",
                "-o",
                file("learned.csv")});
  }
};

TEST_F(WeightsVerbsTest, ObservationsFromOffTheMapAreNamedAsTheCause) {
  simulate();
  carry_off(0);
  EXPECT_EQ(learn(), 1);
  EXPECT_THAT(errors_, HasSubstr("nothing to learn from: 4 of 4 observations stand off map"));
  EXPECT_THAT(errors_, HasSubstr("run, frame 1 at (10"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "learned.csv"));
}

TEST_F(WeightsVerbsTest, ALargeShareOffTheMapIsWarnedOf) {
  simulate();
  ASSERT_EQ(learn(), 0) << errors_;
  EXPECT_EQ(errors_, "");
  carry_off(2);
  ASSERT_EQ(learn(), 0) << errors_;
  EXPECT_THAT(errors_, HasSubstr(" of 4 observations stand off map"));
  EXPECT_THAT(errors_, HasSubstr("is it the right map?"));
}

TEST_F(WeightsVerbsTest, AMatrixIsNotJudgedOnTheLogThatItWasLearnedFrom) {
  simulate();
  ASSERT_EQ(learn(), 0) << errors_;
  const auto evaluate = [this](const std::string& log) {
    return run({"evaluate",
                "logs",
                "--map",
                kMap,
                log,
                "--runs",
                "1",
                "--learned",
                file("learned.csv"),
                "--methods",
                "ours",
                "--columns",
                "120",
                "--rows",
                "30"});
  };
  std::filesystem::copy(
      folder_ / "run", folder_ / "copy", std::filesystem::copy_options::recursive);
  for (const char* const log : {"run", "copy"}) {
    EXPECT_EQ(evaluate(file(log)), 1) << output_;
    EXPECT_THAT(errors_, HasSubstr("learned.csv: was learned from log " + file(log)));
  }
  ASSERT_EQ(run({"simulate", kMap, "--out", file("other"), "--steps", "4", "--seed", "2"}), 0);
  EXPECT_EQ(evaluate(file("other")), 0) << errors_;
}

TEST_F(WeightsVerbsTest, FramesThatTheTruthDoesNotReachAreCounted) {
  simulate();
  auto truth = io::read_tum(file("run/groundtruth.txt")).value();
  truth.resize(1);
  ASSERT_TRUE(io::write_tum(file("run/groundtruth.txt"), truth));
  EXPECT_EQ(learn(), 0) << errors_;
  EXPECT_THAT(errors_, HasSubstr("run: 3 of 4 frames are not learned from"));
  EXPECT_EQ(run({"weights", "learn", kMap, file("run"), "--bands", "0", "-o", file("x.csv")}), 2);
  EXPECT_THAT(errors_, HasSubstr("--bands: 0 elevation bands"));
}

TEST_F(WeightsVerbsTest, ShowLeavesItsPictureAlsoWhereNobodyReadsTheTable) {
  // The reader is gone before the first line.
  const std::string command = "'" SEMVIEW_BINARY_DIR "/semview' weights show " SEMVIEW_SOURCE_DIR
                              "/maps/duplex_level1/weights.csv --all -o " +
                              file("weights.png") + " | true";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(io::png_size(file("weights.png")));
}

TEST_F(WeightsVerbsTest, ShowPrintsTheMatrixForScripts) {
  const auto csv = folder_.write("w.csv", "observed,wall,floor\nwall,1,-0.5\nlamp,0,0\n");
  ASSERT_EQ(run({"weights", "show", csv.string(), "--json"}), 0) << errors_;
  const auto json = nlohmann::json::parse(output_);
  EXPECT_EQ(json["observed"], (std::vector<std::string>{"wall"})) << "a lamp says nothing";
  EXPECT_EQ(json["map"], (std::vector<std::string>{"wall", "floor"}));
  ASSERT_EQ(json["bands"].size(), 1U);
  EXPECT_EQ(json["bands"][0]["weights"], nlohmann::json::parse("[[1.0, -0.5]]"));
}

}  // namespace
}  // namespace semview
