// SPDX-License-Identifier: Apache-2.0
/// `semview weights|score|heatmap` as a user runs them, on a shipped plan.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "semview/io/observation_folder.hpp"
#include "semview/io/png.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/service/site.hpp"
#include "support/engine_wish.hpp"
#include "support/run_program.hpp"
#include "support/running_server.hpp"

namespace semview {
namespace {

using nlohmann::json;
using semview::testing::Outcome;
using ::testing::HasSubstr;

/// An observation cast from the centre of a free cell of the duplex, turned by 90°.
class ScoreVerbsTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::filesystem::temp_directory_path() /
              ("semview_score_verbs_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    service::SiteConfig config;
    config.threads = 1;
    config.engine = testing::engine_wish();
    const auto site = service::Site::open(kMap, config).value();
    const std::vector<CellIndex> cells = site->cells().free_cells();
    truth_ = PoseGrid::center(GridKey{cells[cells.size() / 2], 30});
    raycast::PanoramaRequest request;
    request.map_from_robot = truth_;
    request.eye_z_m = site->eye_z_m(1.2);
    const auto panorama = site->exact_panorama(request).value();
    io::ObservationSetup setup;
    setup.classes = site->map().classes;
    ASSERT_TRUE(io::write_observation(folder_ / "obs", setup, panorama.labels, 1.0));
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder_); }

  static Outcome run(const std::string& arguments) {
    return semview::testing::run_semview(arguments);
  }
  static std::string file(const std::string& name) { return (folder_ / name).string(); }
  static std::string inputs() {
    return std::string(kMap) + " --obs " + file("obs") + " --weights " + kMap + "/weights.csv";
  }

  static constexpr const char* kMap = SEMVIEW_SOURCE_DIR "/maps/duplex_level1";
  inline static std::filesystem::path folder_;
  inline static Pose2 truth_;
};

TEST_F(ScoreVerbsTest, TheCompassFindsTheHeadingAtTheTruePosition) {
  const std::string pose = std::to_string(truth_.x_m) + "," + std::to_string(truth_.y_m) + ",0";
  const Outcome outcome =
      run("score " + inputs() + " --pose " + pose + " --compass --curve --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const json result = json::parse(outcome.answer);
  EXPECT_EQ(result["observed_pixels"], 360 * 90);
  EXPECT_EQ(result["poses"][0]["curve"].size(), 120U);
  EXPECT_NEAR(result["poses"][0]["best_yaw_deg"].get<double>(), 90.0, 1e-9);
  EXPECT_EQ(result["poses"][0]["similarity"], result["poses"][0]["curve"][30]);
}

TEST_F(ScoreVerbsTest, PosesOfAFileAreScoredInOrder) {
  std::ofstream(file("poses.csv")) << "x,y,yaw_deg\n"
                                   << truth_.x_m << "," << truth_.y_m << ",90\n"
                                   << "# far outside\n1000,1000,0\n";
  const Outcome outcome = run("score " + inputs() + " --poses " + file("poses.csv") + " --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const json poses = json::parse(outcome.answer)["poses"];
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_GT(poses[0]["similarity"].get<double>(), 0.2);
  EXPECT_TRUE(poses[1]["similarity"].is_null());
}

TEST_F(ScoreVerbsTest, AnExplanationAddsUpToTheScoreAndAServersIsTheSame) {
  const std::string pose =
      " --pose " + std::to_string(truth_.x_m + 0.3) + "," + std::to_string(truth_.y_m) + ",0";
  const std::string how = " --compass --json --explain ";
  const Outcome here = run("score " + inputs() + pose + how + file("why.png"));
  ASSERT_EQ(here.exit_code, 0) << here.output;
  const json result = json::parse(here.answer);
  for (const char* table : {"observed", "pairs"}) {
    int sum = 0;
    int pixels = 0;
    for (const json& entry : result["explanation"][table]) {
      sum += entry["sum"].get<int>();
      pixels += entry["pixels"].get<int>();
    }
    EXPECT_EQ(sum, result["poses"][0]["sum"]) << table;
    EXPECT_EQ(pixels, result["observed_pixels"]) << table;
  }
  EXPECT_GT(io::read_png_rgb(file("why.png"))->rows(), 300);

  const semview::testing::RunningServer server({"--map", kMap, "--bind", "tcp://127.0.0.1:*"},
                                               folder_ / "explaining");
  const Outcome there =
      run("score duplex_level1 --server " + server.endpoint() + " --obs " + file("obs") +
          " --weights " + kMap + "/weights.csv" + pose + how + file("theirs.png"));
  ASSERT_EQ(there.exit_code, 0) << there.output;
  EXPECT_EQ(json::parse(there.answer)["explanation"], result["explanation"]);
  EXPECT_EQ(semview::testing::file_bytes(file("theirs.png")),
            semview::testing::file_bytes(file("why.png")));

  const Outcome table = run("score " + inputs() + pose + " --explain " + file("why.png"));
  EXPECT_THAT(table.output, HasSubstr("observed,map,share,contribution"));
  const Outcome outside =
      run("score " + inputs() + " --pose 1000,1000,0 --explain " + file("why.png"));
  EXPECT_EQ(outside.exit_code, 1);
  EXPECT_THAT(outside.output, HasSubstr("there is no view at"));
  std::ofstream(file("two.csv")) << "1,2,0\n1,2,90\n";
  EXPECT_EQ(
      run("score " + inputs() + " --poses " + file("two.csv") + " --explain " + file("why.png"))
          .exit_code,
      2);
}

TEST_F(ScoreVerbsTest, TheHeatMapIsHighestWhereTheRobotStands) {
  const Outcome outcome = run("heatmap " + inputs() + " --columns 120 --rows 30 -o " +
                              file("heat.png") + " --npy " + file("heat.npy") + " --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const json result = json::parse(outcome.answer);
  EXPECT_NEAR(result["best"]["x_m"].get<double>(), truth_.x_m, 1e-9);
  EXPECT_NEAR(result["best"]["y_m"].get<double>(), truth_.y_m, 1e-9);
  EXPECT_NEAR(result["best"]["yaw_deg"].get<double>(), 90.0, 1e-9);
  EXPECT_GT(std::filesystem::file_size(file("heat.npy")), 1000U);
  EXPECT_TRUE(io::read_png_rgb(file("heat.png")));
  const json beside = json::parse(std::ifstream(file("heat.json")));
  EXPECT_EQ(beside["fingerprint"], result["fingerprint"]);
  EXPECT_EQ(beside["step_m"], 0.1);
}

/// The values of a `.npy` of float32.
std::vector<float> values_of(const std::string& npy) {
  std::ifstream stream(npy, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t header = bytes.find('\n') + 1;
  std::vector<float> values((bytes.size() - header) / sizeof(float));
  std::memcpy(values.data(), bytes.data() + header, values.size() * sizeof(float));
  return values;
}

TEST_F(ScoreVerbsTest, ThePosteriorAddsUpToOneAndIsHighestWhereTheRobotStands) {
  const Outcome outcome =
      run("heatmap " + inputs() + " --columns 120 --rows 30 --posterior -o " +
          file("posterior.png") + " --npy " + file("posterior.npy") + " --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const json about = json::parse(std::ifstream(file("posterior.json")));
  EXPECT_EQ(about["quantity"], "probability");
  EXPECT_EQ(about["weighting"], (json{{"transform", "power"}, {"power", 20.0}}));
  EXPECT_NEAR(about["best"]["x_m"].get<double>(), truth_.x_m, 1e-9);
  EXPECT_NEAR(about["best"]["y_m"].get<double>(), truth_.y_m, 1e-9);
  double sum = 0.0;
  float highest = 0.0F;
  for (const float value : values_of(file("posterior.npy"))) {
    if (std::isnan(value)) continue;
    sum += static_cast<double>(value);
    highest = std::max(highest, value);
  }
  EXPECT_NEAR(sum, 1.0, 1e-5);
  EXPECT_EQ(about["best"]["probability"].get<float>(), highest);
}

TEST_F(ScoreVerbsTest, AServersHeatMapsHaveTheBytesOfThoseMadeHere) {
  std::ofstream(file("server.yaml")) << "profile: {columns: 120, rows: 30}\n";
  const semview::testing::RunningServer server(
      {"--map", kMap, "--config", file("server.yaml"), "--bind", "tcp://127.0.0.1:*"},
      folder_ / "server");
  const std::string remote = "heatmap duplex_level1 --server " + server.endpoint() + " --obs " +
                             file("obs") + " --weights " + kMap + "/weights.csv";
  for (const std::string how : {"", " --posterior --weighting exponential --kappa 30"}) {
    const Outcome here = run("heatmap " + inputs() + " --columns 120 --rows 30" + how + " -o " +
                             file("here.png") + " --npy " + file("here.npy"));
    const Outcome there =
        run(remote + how + " -o " + file("there.png") + " --npy " + file("there.npy"));
    ASSERT_EQ(here.exit_code, 0) << here.output;
    ASSERT_EQ(there.exit_code, 0) << there.output;
    EXPECT_EQ(semview::testing::file_bytes(file("here.npy")),
              semview::testing::file_bytes(file("there.npy")));
    json own = json::parse(std::ifstream(file("here.json")));
    json servers = json::parse(std::ifstream(file("there.json")));
    own.erase("cells");  // from memory, the second time
    servers.erase("cells");
    EXPECT_EQ(own, servers);
  }
}

TEST_F(ScoreVerbsTest, WeightsInitWritesWhatWeightsCheckAccepts) {
  const std::string csv = file("w.csv");
  const Outcome init = run("weights init " + std::string(kMap) + " -o " + csv + " --json");
  ASSERT_EQ(init.exit_code, 0) << init.output;
  EXPECT_TRUE(json::parse(init.answer)["unmatched_map"].empty());
  EXPECT_EQ(
      run("weights check " + std::string(kMap) + " " + csv + " --vocabulary ade20k150").exit_code,
      0);
  const Outcome check =
      run("weights check " SEMVIEW_SOURCE_DIR "/maps/largebuilding_level1 " + csv);
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_THAT(check.output, HasSubstr("no column for map class desk"));
}

TEST_F(ScoreVerbsTest, WrongUsageEndsWithTwoAndWrongInputWithOne) {
  EXPECT_EQ(run("score " + inputs()).exit_code, 2);
  EXPECT_EQ(run("score " + inputs() + " --pose 1,2").exit_code, 2);
  EXPECT_EQ(
      run("heatmap " + inputs() + " --columns 120 --rows 30 -o " + file("x.png") + " --headings 7")
          .exit_code,
      2);
  const Outcome missing = run("score " + std::string(kMap) + " --obs " + file("obs") +
                              " --weights " + file("none.csv") + " --pose 1,2,3");
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.output, HasSubstr("none.csv: cannot be read"));
}

}  // namespace
}  // namespace semview
