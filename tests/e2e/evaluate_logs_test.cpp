// SPDX-License-Identifier: Apache-2.0
// `semview evaluate logs`: the tables of the 2017 paper for recordings of somebody's own.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "semview/io/run_log.hpp"
#include "semview/io/trajectory.hpp"
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

class EvaluateLogsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* seed : {"1", "2"}) {
      const Outcome outcome = run_semview("simulate " + kMap + " --steps 5 --seed " + seed +
                                          " --out " + file(std::string("drive") + seed));
      ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    }
  }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  Outcome evaluate(const std::string& options) const {
    return run_semview("evaluate logs --map " + kMap + " " + file("drive1") + " " + file("drive2") +
                       " --columns 120 --rows 30 " + options);
  }

  /// What somebody's program might give: for each frame `truth`, or odometry from where it starts.
  void write_estimates(const std::string& folder, bool truth) const {
    std::filesystem::create_directories(file(folder));
    for (const std::string drive : {"drive1", "drive2"}) {
      const auto log = io::read_run_log(file(drive));
      ASSERT_TRUE(log) << log.error().message;
      std::vector<io::StampedPose2> poses;
      Pose2 map_from_odom;
      for (const io::FrameFiles& frame : log->frames) {
        const Pose2 place = io::interpolate(*log->groundtruth, frame.stamp_s).value();
        const Pose2 odometry = io::interpolate(log->odometry, frame.stamp_s).value();
        if (poses.empty()) map_from_odom = place * inverse(odometry);
        poses.push_back({frame.stamp_s, truth ? place : map_from_odom * odometry});
      }
      ASSERT_TRUE(io::write_tum(file(folder + "/" + drive + ".tum"), poses));
    }
  }

  testing::TemporaryFolder folder_;
};

TEST_F(EvaluateLogsTest, ThreadsChangeNoByteAndOdometryIsItsOwnEstimate) {
  write_estimates("reckoned", false);
  write_estimates("perfect", true);
  const std::string options =
      "--methods weighted,ours --runs 2 --json --estimates reckoned=" + file("reckoned") +
      " --estimates perfect=" + file("perfect");
  const Outcome one = evaluate(options + " --threads 1 --out " + file("one"));
  ASSERT_EQ(one.exit_code, 0) << one.output;
  const Outcome two = evaluate(options + " --threads 2 --out " + file("two"));
  ASSERT_EQ(two.exit_code, 0) << two.output;
  EXPECT_EQ(file_bytes(file("one/runs.csv")), file_bytes(file("two/runs.csv")));
  EXPECT_EQ(one.output, two.output);

  const auto rows = nlohmann::json::parse(one.answer)["rows"];
  ASSERT_EQ(rows.size(), 12U);  // two logs and all of them, four methods
  for (const auto& row : rows) {
    const bool all = row["log"] == "all logs";
    const bool foreign = row["method"] == "reckoned" || row["method"] == "perfect";
    EXPECT_EQ(row["drives"], (all ? 2 : 1) * (foreign ? 1 : 2)) << row;
    EXPECT_EQ(row["min_m"].is_null(), foreign) << row;
    if (row["method"] == "perfect") {
      EXPECT_NEAR(row["estimate_m"].get<double>(), 0.0, 1e-6);
      EXPECT_EQ(row["localized_from_image"], 1.0);
    }
    if (row["method"] == "reckoned") {
      EXPECT_GT(row["odometry_m"].get<double>(), 0.0);
      EXPECT_NEAR(row["estimate_m"].get<double>(), row["odometry_m"].get<double>(), 1e-6);
    }
    if (row["method"] == "weighted") {
      EXPECT_LE(row["min_m"].get<double>(), row["best_m"].get<double>());
    }
  }
}

TEST_F(EvaluateLogsTest, PrintsTablesOfEachLogAndOfAll) {
  const Outcome outcome = evaluate("--methods identity,weighted --runs 1 --starts local,global");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output,
              HasSubstr("| row | identity: best (min) | weighted: best (min) | odometry |\n"));
  EXPECT_THAT(outcome.output, HasSubstr("Mean error in m, global localization"));
  EXPECT_THAT(outcome.output, HasSubstr("| drive2 |"));
  EXPECT_THAT(outcome.output, HasSubstr("| all logs |"));
  EXPECT_THAT(outcome.output, HasSubstr("median over logs"));
}

TEST_F(EvaluateLogsTest, TablesOfEarlierRunsAreNotWrittenOver) {
  const std::string options = "--methods weighted --runs 1 --out " + file("out");
  const Outcome first = evaluate(options);
  ASSERT_EQ(first.exit_code, 0) << first.output;
  const std::string kept = file_bytes(file("out/runs.csv"));
  const Outcome second = evaluate(options + " --seed 2");
  EXPECT_EQ(second.exit_code, 1) << second.output;
  EXPECT_THAT(second.output, HasSubstr("out: holds results already (runs.csv)"));
  EXPECT_EQ(file_bytes(file("out/runs.csv")), kept);
}

TEST_F(EvaluateLogsTest, LogsMayStandBehindLists) {
  const Outcome outcome =
      run_semview("evaluate logs --columns 120 --rows 30 --runs 1 --map " + kMap +
                  " --starts local --methods weighted " + file("drive1"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("| row | weighted: best (min) | odometry |\n"));
}

TEST_F(EvaluateLogsTest, WhatCannotBeComparedIsRefusedInALine) {
  const Outcome twice =
      run_semview("evaluate logs --map " + kMap + " " + file("drive1") + " " + file("drive1"));
  EXPECT_EQ(twice.exit_code, 1) << twice.output;
  EXPECT_THAT(twice.output, HasSubstr("another log is called drive1, too"));

  const Outcome missing = evaluate("--estimates theirs=" + file("nowhere"));
  EXPECT_EQ(missing.exit_code, 1) << missing.output;
  EXPECT_THAT(missing.output, HasSubstr("nowhere/drive1.tum: is missing"));

  std::filesystem::remove(file("drive2/groundtruth.txt"));
  const Outcome blind = evaluate("");
  EXPECT_EQ(blind.exit_code, 1) << blind.output;
  EXPECT_THAT(blind.output, HasSubstr("drive2: has no groundtruth.txt to compare with"));

  EXPECT_EQ(evaluate("--methods best").exit_code, 2);
  EXPECT_EQ(evaluate("--starts here").exit_code, 2);
}

}  // namespace
}  // namespace semview
