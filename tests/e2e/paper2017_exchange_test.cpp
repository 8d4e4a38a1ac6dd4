// SPDX-License-Identifier: Apache-2.0
// The experiment of the 2017 paper for other people's programs: worlds out, trajectories back.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/paper2017/records.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/io/run_log.hpp"
#include "semview/io/text_file.hpp"
#include "semview/io/trajectory.hpp"
#include "support/paths.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace semview::paper2017 {
namespace {

using semview::testing::Outcome;
using semview::testing::run_command;
using semview::testing::run_semview;
using ::testing::HasSubstr;

const std::string kRowsAndWorlds = "--rows shear_0.3,fov_100 --worlds 1";
const std::string kChosen = kRowsAndWorlds + " --starts local";

/// Two rows of a world, exported once, and what dead reckoning made of them.
class Paper2017ExchangeTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new testing::TemporaryFolder;
    const Outcome exported =
        run_semview("evaluate paper2017 " + kRowsAndWorlds + " --export " + file("exported"));
    ASSERT_EQ(exported.exit_code, 0) << exported.output;
    const Outcome reckoned =
        run_command("python3 " SEMVIEW_SOURCE_DIR "/experiments/paper2017/dead_reckoning.py " +
                    file("exported/input") + " " + file("reckoned"));
    ASSERT_EQ(reckoned.exit_code, 0) << reckoned.output;
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string file(const std::string& name) { return (*folder_ / name).string(); }

  static std::vector<TrialRecord> trials(const std::string& csv) {
    const auto text = io::read_text_file(csv, std::size_t{1} << 24U);
    auto records = parse_trials(text ? *text : "", csv);
    return records ? *std::move(records) : std::vector<TrialRecord>();
  }

  /// The estimates in `folder` are refused with `words`, in one line and before anything is run.
  static void expect_refused(const std::string& folder, const std::string& words) {
    const Outcome outcome = run_semview("evaluate paper2017 " + kChosen + " --out " +
                                        file("never") + " --estimates theirs=" + file(folder));
    EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr(words));
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(file("never")));
  }

  /// A copy of the reckoned trajectories, that of shear_0.3 replaced.
  static void copy_with(const std::string& folder, const std::vector<io::StampedPose2>& track) {
    std::filesystem::copy(file("reckoned"), file(folder), std::filesystem::copy_options::recursive);
    ASSERT_TRUE(io::write_tum(file(folder + "/shear_0.3/world_1.tum"), track));
  }

  static testing::TemporaryFolder* folder_;
};

testing::TemporaryFolder* Paper2017ExchangeTest::folder_ = nullptr;

TEST_F(Paper2017ExchangeTest, WhatAMethodIsGivenHoldsNoTruth) {
  const std::string place = "exported/input/shear_0.3/world_1/";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(file("exported/input"))) {
    EXPECT_NE(entry.path().filename(), "groundtruth.txt");
  }
  const auto log = io::read_run_log(file(place + "log"));
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(log->frames.size(), 14U);
  EXPECT_FALSE(log->groundtruth);
  for (const char* map : {"map", "map_stacked"}) {
    EXPECT_EQ(run_semview("map check " + file(place + map)).exit_code, 0) << map;
  }
  const auto start = io::read_tum(file(place + "start.tum"));
  const auto truth = io::read_tum(file("exported/truth/shear_0.3/world_1.tum"));
  ASSERT_TRUE(start && truth);
  ASSERT_EQ(start->size(), 1U);
  EXPECT_EQ(start->front(), truth->front());
  const auto list = io::read_text_file(file("exported/input/list.csv"), 10'000);
  ASSERT_TRUE(list);
  EXPECT_THAT(*list,
              HasSubstr("fov_100,1,fov_100/world_1/map,fov_100/world_1/map_stacked,"
                        "fov_100/world_1/log,fov_100/world_1/start.tum,fov_100/world_1.tum\n"));
}

TEST_F(Paper2017ExchangeTest, DeadReckoningElsewhereIsTheTablesOdometry) {
  const Outcome outcome =
      run_semview("evaluate paper2017 " + kChosen + " --runs 1 --methods weighted --out " +
                  file("results") + " --estimates reckoned=" + file("reckoned"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output,
              HasSubstr("| row | weighted: best (min) | reckoned: own estimate | odometry |"));
  const std::vector<TrialRecord> theirs = trials(file("results/estimates.csv"));
  const std::vector<TrialRecord> ours = trials(file("results/runs.csv"));
  ASSERT_EQ(theirs.size(), 2U);
  ASSERT_EQ(ours.size(), 2U);
  for (std::size_t row = 0; row < 2; ++row) {
    ASSERT_EQ(theirs[row].row, ours[row].row);
    ASSERT_EQ(theirs[row].stops.size(), 14U);
    for (std::size_t i = 0; i < 14; ++i) {
      // Both files have 6 decimals, trajectories 9.
      EXPECT_NEAR(theirs[row].stops[i].estimate_m, ours[row].stops[i].odometry_m, 2e-6);
    }
  }

  // The product's own localizer on the exported recording, set as the method `weighted` is.
  const std::string place = "exported/input/fov_100/world_1/";
  const Pose2 start = io::read_tum(file(place + "start.tum"))->front().pose;
  const Outcome localized = run_semview(fmt::format(
      "localize --log {} --map {} --init {:.6f},{:.6f},{:.4f},0.1 --init-heading-sigma 3 "
      "--heading compass --compass-gain 0 --weighting power --power 16 --motion paper --sigma 0.5 "
      "--heading-sigma 0.3 --resample-threshold 1 --estimate best --columns 120 --rows 38 "
      "--elevation -38,38 -o {}",
      file(place + "log"),
      file(place + "map"),
      start.x_m,
      start.y_m,
      deg_from_rad(start.yaw_rad),
      file("localized.tum")));
  ASSERT_EQ(localized.exit_code, 0) << localized.output;
  const auto poses = io::read_tum(file("localized.tum"));
  const auto truth = io::read_tum(file("exported/truth/fov_100/world_1.tum"));
  ASSERT_TRUE(poses && truth);
  ASSERT_EQ(poses->size(), truth->size());
  double localized_m = 0.0;
  double weighted_m = 0.0;
  for (std::size_t i = 0; i < truth->size(); ++i) {
    localized_m += distance_m((*poses)[i].pose, (*truth)[i].pose) / 14.0;
    weighted_m += ours[1].stops[i].best_m / 14.0;
  }
  // Two draws of one filter: a few decimetres of spread from seed to seed, no more.
  EXPECT_NEAR(localized_m, weighted_m, 0.25);
}

TEST_F(Paper2017ExchangeTest, TrajectoriesThatDoNotFitAreRefusedInALine) {
  const auto track = io::read_tum(file("reckoned/shear_0.3/world_1.tum")).value();
  std::filesystem::create_directories(file("none"));
  expect_refused("none", "none/shear_0.3/world_1.tum: is missing; expected one for each of 2 rows");

  auto short_track = track;
  short_track.pop_back();
  copy_with("short", short_track);
  expect_refused("short", "world_1.tum: no pose at 14 s, frame 14 of 14");

  auto between = track;
  between[4].stamp_s += 0.5;
  copy_with("between", between);
  expect_refused("between", "no pose at 5 s, frame 5 of 14");

  auto endless = track;
  endless[2].pose.x_m = INFINITY;
  copy_with("endless", endless);
  expect_refused("endless", "world_1.tum:4: expected eight finite numbers");
}

TEST_F(Paper2017ExchangeTest, ANameThatIsTakenIsRefused) {
  for (const char* name : {"ours", "odometry", "a b", ""}) {
    const Outcome outcome =
        run_semview(fmt::format("evaluate paper2017 --estimates '{}={}'", name, file("reckoned")));
    EXPECT_EQ(outcome.exit_code, 2) << name << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("--estimates"));
  }
}

}  // namespace
}  // namespace semview::paper2017
