// SPDX-License-Identifier: Apache-2.0
/// `semview locate` and `semview evaluate images` as a user runs them.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "segmentation/colour_network.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/io/observation_folder.hpp"
#include "semview/io/png.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/service/site.hpp"
#include "service/small_map.hpp"
#include "support/run_program.hpp"

namespace semview {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class LocateVerbTest : public ::testing::Test {
 protected:
  void SetUp() override {
    service::SiteConfig config;
    config.threads = 1;
    config.profile.camera = {360, 150, -rad_from_deg(75.0), rad_from_deg(75.0)};
    const auto site = service::Site::open(map_, config).value();
    raycast::PanoramaRequest request;
    request.map_from_robot = truth_;
    request.eye_z_m = site->eye_z_m(1.2);
    request.camera = site->profile().camera;
    io::ObservationSetup setup;
    setup.classes = site->map().classes;
    PartialPanorama whole;
    whole.elevation_min_rad = -rad_from_deg(75.0);
    whole.elevation_max_rad = rad_from_deg(75.0);
    setup.camera = whole;
    ASSERT_TRUE(io::write_observation(
        folder_ / "obs", setup, site->exact_panorama(request).value().labels, 0.0));
  }

  std::string file(const char* name) const { return (folder_ / name).string(); }

  testing::TemporaryFolder folder_;
  const std::filesystem::path map_ = testing::write_small_map(folder_);
  const Pose2 truth_{0.93, 0.87, rad_from_deg(-52.4)};
};

TEST_F(LocateVerbTest, PrintsPlacesAndDrawsWhereItMayBe) {
  const auto run = testing::run_semview(
      "locate " + map_.string() + " --obs " + file("obs") +
      " --eye-height 1.2 --rows 150 --elevation -75,75 --top 3 --json --heatmap " +
      file("where.png"));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const json answer = json::parse(run.answer);
  ASSERT_GE(answer["places"].size(), 1U);
  ASSERT_LE(answer["places"].size(), 3U);
  const json& best = answer["places"][0];
  EXPECT_NEAR(best["x_m"].get<double>(), truth_.x_m, 0.03);
  EXPECT_NEAR(best["y_m"].get<double>(), truth_.y_m, 0.03);
  EXPECT_NEAR(best["yaw_rad"].get<double>(), truth_.yaw_rad, rad_from_deg(2.0));
  EXPECT_GT(best["probability"].get<double>(), 0.0);
  EXPECT_GE(answer["ambiguity"]["effective_places"].get<double>(), 1.0);
  EXPECT_TRUE(io::png_size(file("where.png")));
}

TEST_F(LocateVerbTest, AnEyeHeightTwiceIsRefused) {
  const auto run = testing::run_semview("locate " + map_.string() + " --obs " + file("obs") +
                                        " --eye-height 1.2 1.2");
  EXPECT_EQ(run.exit_code, 2) << run.output;
  EXPECT_THAT(run.output, HasSubstr("--eye-height 1.2: is named twice"));
}

TEST_F(LocateVerbTest, CountsHowOftenAListedPictureIsFound) {
  std::ofstream(file("poses.csv")) << "folder,x_m,y_m,yaw_deg\nobs,0.93,0.87,-52.4\n";
  const auto run = testing::run_semview("evaluate images --map " + map_.string() + " --list " +
                                        file("poses.csv") +
                                        " --eye-height 1.2 --rows 150 --elevation -75,75 --json");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const json answer = json::parse(run.answer);
  EXPECT_EQ(answer["rows"][0]["method"], "semview");
  EXPECT_EQ(answer["rows"][0]["pictures"], 1);
  EXPECT_EQ(answer["rows"][0]["located_0.5m_15deg"], 1.0);
  EXPECT_LT(answer["rows"][0]["median_m"].get<double>(), 0.05);
}

TEST_F(LocateVerbTest, AListedPhotographIsLabelledAsObserveLabelsIt) {
  const auto site = service::Site::open(map_, service::SiteConfig{}).value();
  raycast::PanoramaRequest request;
  request.map_from_robot = truth_;
  request.eye_z_m = site->eye_z_m(1.2);
  request.camera = {360, 180, -kPi / 2.0, kPi / 2.0};
  const LabelImage labels = site->exact_panorama(request).value().labels;
  RgbImage photo(labels.rows(), labels.columns(), Rgb{});
  for (int r = 0; r < labels.rows(); ++r) {
    for (int c = 0; c < labels.columns(); ++c) {
      photo.at(r, c) = segmentation::testing::colour_of_channel(std::max(1, +labels.at(r, c)) - 1);
    }
  }
  ASSERT_TRUE(io::write_png(file("room.png"), photo));
  const auto names = site->map().classes.names();
  const std::string model =
      segmentation::testing::write_colour_network(folder_, {names.begin(), names.end()}, 64, 200.0)
          .string();
  ASSERT_EQ(testing::run_semview("observe " + file("room.png") + " --equirectangular --model " +
                                 model + " -o " + file("seen"))
                .exit_code,
            0);
  std::ofstream(file("photos.csv")) << "room.png,0.93,0.87,-52.4\n";
  std::ofstream(file("folders.csv")) << "seen,0.93,0.87,-52.4\n";
  const auto evaluated = [&](const std::string& options) {
    const auto run = testing::run_semview("evaluate images --map " + map_.string() + options +
                                          " --eye-height 1.2 --rows 150 --elevation -75,75 --json");
    EXPECT_EQ(run.exit_code, 0) << run.output;
    return json::parse(run.answer);
  };
  const json photos = evaluated(" --list " + file("photos.csv") + " --segment " + model);
  EXPECT_EQ(photos, evaluated(" --list " + file("folders.csv")));
  EXPECT_EQ(photos["rows"][0]["pictures"], 1);

  const auto unlabelled = testing::run_semview("evaluate images --map " + map_.string() +
                                               " --list " + file("photos.csv"));
  EXPECT_EQ(unlabelled.exit_code, 1);
  EXPECT_THAT(unlabelled.output, HasSubstr("photos.csv:1: room.png is a photograph; expected"));
}

TEST_F(LocateVerbTest, AMapIsNotTestedWithPicturesOfItself) {
  const auto run = testing::run_semview("evaluate images --map " + map_.string() + " --world " +
                                        map_.string() + " --pictures 1");
  EXPECT_EQ(run.exit_code, 1) << run.output;
  EXPECT_THAT(run.output, HasSubstr("is the map itself"));
}

TEST_F(LocateVerbTest, NamesTheLineOfAListThatIsNone) {
  std::ofstream(file("poses.csv")) << "folder,x_m,y_m,yaw_deg\nobs,0.93,here\n";
  const auto run = testing::run_semview("evaluate images --map " + map_.string() + " --list " +
                                        file("poses.csv") + " --eye-height 1.2");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.output, HasSubstr("poses.csv:2: expected picture,x_m,y_m,yaw_deg"));
  std::ofstream(file("far.csv")) << "obs,1000,0.87,-52.4\n";
  const auto far = testing::run_semview("evaluate images --map " + map_.string() + " --list " +
                                        file("far.csv") + " --eye-height 1.2");
  EXPECT_EQ(far.exit_code, 1);
  EXPECT_THAT(far.output, HasSubstr("far.csv:1: (1000, 0.87) is not on the map"));
  const auto neither = testing::run_semview("evaluate images --map " + map_.string());
  EXPECT_EQ(neither.exit_code, 2) << neither.output;
}

}  // namespace
}  // namespace semview
