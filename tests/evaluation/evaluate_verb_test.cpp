// SPDX-License-Identifier: Apache-2.0
/// The built program, run on a log made here.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "semview/io/png.hpp"
#include "semview/io/run_log.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace semview {
namespace {

using semview::testing::file_bytes;
using semview::testing::Outcome;
using semview::testing::run_semview;
using semview::testing::TemporaryFolder;
using ::testing::HasSubstr;

class EvaluateRunTest : public ::testing::Test {
 protected:
  /// Truth along x at 1 m/s for 4 s; odometry drifts sideways to 0.8 m; the estimate ends 0.1 m
  /// off.
  void SetUp() override {
    std::vector<io::StampedPose2> truth;
    std::vector<io::StampedPose2> odometry;
    std::vector<io::StampedPose2> estimate;
    for (int t = 0; t <= 4; ++t) {
      truth.push_back({t + 0.0, {t + 1.0, 2.0, 0.0}});
      odometry.push_back({t + 0.0, {t + 0.0, 0.2 * t, 0.0}});
      estimate.push_back({t + 0.0, {t + 1.0, t < 2 ? 3.0 : 2.1, 0.0}});
    }
    Result<io::RunLogWriter> writer =
        io::RunLogWriter::create(folder_ / "log", {ClassTable({"wall"}), PartialPanorama{}});
    ASSERT_TRUE(writer);
    ASSERT_TRUE(writer->add_frame(0.0, LabelImage(9, 120, 1)));
    ASSERT_TRUE(writer->finish(odometry, truth));
    ASSERT_TRUE(io::write_tum(folder_ / "est.tum", estimate));
  }

  std::string arguments(const std::string& more) const {
    return "evaluate run --log " + (folder_ / "log").string() + " " +
           (folder_ / "est.tum").string() + " " + more;
  }

  TemporaryFolder folder_;
};

TEST_F(EvaluateRunTest, JsonHoldsTheErrorsBesideOdometrys) {
  const Outcome outcome = run_semview(arguments("--json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const nlohmann::json json = nlohmann::json::parse(outcome.answer);
  const nlohmann::json& result = json.at("estimates").at(0);
  EXPECT_NEAR(result.at("estimate").at("position_m").at("final").get<double>(), 0.1, 1e-6);
  EXPECT_NEAR(result.at("estimate").at("position_m").at("max").get<double>(), 1.0, 1e-6);
  EXPECT_NEAR(result.at("estimate").at("converged_after_s").get<double>(), 2.0, 1e-6);
  EXPECT_NEAR(result.at("odometry").at("position_m").at("final").get<double>(), 0.8, 1e-6);
  EXPECT_TRUE(result.at("odometry").at("converged_after_s").is_null());
}

TEST_F(EvaluateRunTest, PicturesAreWrittenWithAndWithoutAPlan) {
  const std::string png = (folder_ / "a.png").string();
  const std::string svg = (folder_ / "a.svg").string();
  ASSERT_EQ(run_semview(arguments("--png " + png + " --svg " + svg)).exit_code, 0);
  EXPECT_GT(io::png_size(png)->columns, 100);
  EXPECT_THAT(file_bytes(svg), HasSubstr("</svg>"));
  const Outcome with_map =
      run_semview(arguments("--png " + png + " --map " SEMVIEW_SOURCE_DIR "/maps/duplex_level1"));
  EXPECT_EQ(with_map.exit_code, 0) << with_map.output;
}

TEST_F(EvaluateRunTest, TheFinalLimitDecidesTheExitCode) {
  EXPECT_EQ(run_semview(arguments("--final-within 0.3")).exit_code, 0);
  const Outcome outcome = run_semview(arguments("--final-within 0.05"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("ends 0.100 m from the truth, odometry 0.800 m"));
}

TEST_F(EvaluateRunTest, WithoutGroundTruthItSaysSo) {
  std::filesystem::remove(folder_ / "log/groundtruth.txt");
  const Outcome outcome = run_semview(arguments(""));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("has no groundtruth.txt"));
}

TEST_F(EvaluateRunTest, RoomsAreJudgedByPlaceAndByOrder) {
  // The truth goes from x = 1 to 5 m; the estimate's first two poses lie at y = 3 m.
  const std::string header = "room,min_x_m,min_y_m,max_x_m,max_y_m\n";
  const auto building = folder_.write("building.csv", header + "hall,0,0,3.5,9\nlab,3.5,0,9,9\n");
  const auto sketch =
      folder_.write("sketch.csv", header + "hall,0,0,3.5,2.5\nlab,3.5,0,9,9\nattic,0,2.5,3.5,9\n");
  const std::string verb = "evaluate rooms --log " + (folder_ / "log").string() + " " +
                           (folder_ / "est.tum").string() + " --true-rooms " + building.string();
  const Outcome same = run_semview(verb + " --rooms " + building.string());
  ASSERT_EQ(same.exit_code, 0) << same.output;
  EXPECT_THAT(same.output, HasSubstr("in the right room 5 of 5 (100.0 %)"));
  EXPECT_THAT(same.output, HasSubstr("rooms in the right order: yes"));

  const Outcome other = run_semview(verb + " --rooms " + sketch.string());
  ASSERT_EQ(other.exit_code, 0) << other.output;
  EXPECT_THAT(other.output, HasSubstr("rooms in the right order: no"));
  EXPECT_THAT(other.output, HasSubstr("rooms found:   attic, hall, lab"));

  const Outcome json = run_semview(verb + " --rooms " + sketch.string() + " --json");
  ASSERT_EQ(json.exit_code, 0) << json.output;
  const auto result = nlohmann::json::parse(json.answer)["estimates"][0];
  EXPECT_EQ(result["in_right_room"], 3);
  EXPECT_EQ(result["poses"], 5);
  EXPECT_EQ(result["in_right_order"], false);
  EXPECT_EQ(result["rooms_visited"], (std::vector<std::string>{"hall", "lab"}));
}

TEST(EvaluateUsageTest, MissingOptionsAreUsageErrors) {
  EXPECT_EQ(run_semview("evaluate run").exit_code, 2);
  EXPECT_EQ(run_semview("evaluate").exit_code, 2);
}

}  // namespace
}  // namespace semview
