// SPDX-License-Identifier: Apache-2.0
#include "semview/simulation/simulator.hpp"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "semview/io/run_log.hpp"
#include "semview/io/text_file.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "simulation/two_rooms.hpp"
#include "support/engine_wish.hpp"

namespace semview::simulation {
namespace {

class SimulatorTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("semview_simulator_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static SimulationConfig small_config() {
    SimulationConfig config;
    config.engine = testing::engine_wish();
    config.frames = 6;
    config.camera.columns = 240;
    config.camera.rows = 60;
    return config;
  }

  std::filesystem::path folder_;
};

TEST_F(SimulatorTest, PerfectRobotSeesTheMapFromItsTruePoses) {
  SimulationConfig config = small_config();
  config.noise_level = 0.0;
  config.frames = 3;
  config.frame_distance_m = 0.1;  // short of any door
  const map::SemanticMap map = two_rooms();
  const auto report = simulate(map, config, folder_ / "run");
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->wrong_label_share, 0.0);
  EXPECT_EQ(report->engine, testing::plan_engine());
  EXPECT_NEAR(report->odometry_error_m, 0.0, 1e-9);
  ASSERT_EQ(report->opened_doors, 0);

  const auto log = io::read_run_log(folder_ / "run");
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(log->setup.classes, map.classes);
  ASSERT_EQ(log->frames.size(), 3U);
  const auto scene = raycast::Scene::build(map::extrude(*map.columns()));
  ASSERT_TRUE(scene);
  for (std::size_t k = 0; k < 3; ++k) {
    const PanoramaCamera camera{240, 60};
    const auto seen = io::read_frame(*log, k, camera);
    ASSERT_TRUE(seen) << seen.error().message;
    raycast::PanoramaRequest request;
    request.map_from_robot = io::interpolate(*log->groundtruth, log->frames[k].stamp_s).value();
    request.eye_z_m = 1.2;
    request.camera = camera;
    const LabelImage expected = raycast::render_panorama(*scene, request).labels;
    int different = 0;
    for (std::size_t p = 0; p < expected.pixels().size(); ++p) {
      different += seen->labels.pixels()[p] != expected.pixels()[p] ? 1 : 0;
    }
    // Poses are written with nine decimals: a ray along an edge may fall to its other side.
    EXPECT_LE(different, 3) << "frame " << k;
  }
}

TEST_F(SimulatorTest, SameSeedSameFilesOtherSeedOtherFiles) {
  const map::SemanticMap map = two_rooms();
  SimulationConfig config = small_config();
  ASSERT_TRUE(simulate(map, config, folder_ / "a"));
  ASSERT_TRUE(simulate(map, config, folder_ / "b"));
  config.seed = 2;
  ASSERT_TRUE(simulate(map, config, folder_ / "c"));
  const auto text = [&](const char* run, const std::filesystem::path& file) {
    return io::read_text_file(folder_ / run / file, 1 << 24).value();
  };
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "a")) {
    if (!entry.is_regular_file()) continue;
    const auto file = std::filesystem::relative(entry.path(), folder_ / "a");
    EXPECT_EQ(text("a", file), text("b", file)) << file;
    ++files;
  }
  EXPECT_EQ(files, 4 + 6);
  EXPECT_NE(text("a", "odometry.txt"), text("c", "odometry.txt"));
}

TEST_F(SimulatorTest, EachKindOfNoiseHasItsOwnStream) {
  const map::SemanticMap map = two_rooms();
  SimulationConfig config = small_config();
  ASSERT_TRUE(simulate(map, config, folder_ / "a"));
  config.segmentation.blobs_per_sr = 5.0;
  config.camera.height_error_m = 0.0;
  ASSERT_TRUE(simulate(map, config, folder_ / "b"));
  for (const char* file : {"odometry.txt", "groundtruth.txt"}) {
    EXPECT_EQ(io::read_text_file(folder_ / "a" / file, 1 << 24).value(),
              io::read_text_file(folder_ / "b" / file, 1 << 24).value());
  }
}

TEST_F(SimulatorTest, RealisticRunDriftsErrsAndKeepsOffTheWalls) {
  SimulationConfig config = small_config();
  config.frames = 30;
  const auto report = simulate(two_rooms(), config, folder_ / "run");
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->frames, 30);
  EXPECT_NEAR(report->way_m, 15.0, 0.7);
  EXPECT_GT(report->odometry_error_m, 0.1);
  EXPECT_GT(report->wrong_label_share, 0.02);
  EXPECT_GE(report->min_clearance_m, 0.1);
  const auto log = io::read_run_log(folder_ / "run").value();
  // Every frame can be placed by odometry and by ground truth.
  for (const io::FrameFiles& frame : log.frames) {
    EXPECT_TRUE(io::interpolate(log.odometry, frame.stamp_s));
    EXPECT_TRUE(io::interpolate(*log.groundtruth, frame.stamp_s));
  }
}

TEST_F(SimulatorTest, NarrowCameraLeavesTheRestUnknown) {
  SimulationConfig config = small_config();
  config.frames = 1;
  config.noise_level = 0.0;
  config.camera.azimuth_width_rad = kPi / 2.0;
  ASSERT_TRUE(simulate(two_rooms(), config, folder_ / "run"));
  const auto log = io::read_run_log(folder_ / "run").value();
  const auto seen = io::read_frame(log, 0, PanoramaCamera{120, 30});
  ASSERT_TRUE(seen) << seen.error().message;
  for (int c = 0; c < 120; ++c) {
    EXPECT_EQ(seen->labels.at(15, c) != kUnknown, c >= 45 && c < 75) << c;
  }
}

TEST_F(SimulatorTest, WrongConfigurationsNameTheirField) {
  const auto field_of = [&](const SimulationConfig& config) {
    const auto report = simulate(two_rooms(), config, folder_ / "run");
    return report ? std::string("accepted") : report.error().field;
  };
  SimulationConfig config;
  config.frames = 0;
  EXPECT_EQ(field_of(config), "frames");
  config = {};
  config.noise_level = -1.0;
  EXPECT_EQ(field_of(config), "noise_level");
  config = {};
  config.camera.columns = 100;
  EXPECT_EQ(field_of(config), "columns");
}

}  // namespace
}  // namespace semview::simulation
