// SPDX-License-Identifier: Apache-2.0
// What `semview fuse` made is a map like any other.
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "semview/geometry/angle.hpp"
#include "semview/io/png.hpp"
#include "semview/io/trajectory.hpp"
#include "support/depth_log.hpp"
#include "support/paths.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace semview {
namespace {

using semview::testing::Outcome;
using semview::testing::run_command;
using semview::testing::run_semview;
using ::testing::HasSubstr;

class FusedMapTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const Outcome made = run_semview("fuse " SEMVIEW_SOURCE_DIR "/tests/data/rgbd_livingroom1 -o " +
                                     file("room") + " --up -y");
    ASSERT_EQ(made.exit_code, 0) << made.output;
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string volume() const { return file("room/volume.vdb"); }
  Outcome succeed(const std::string& arguments) const {
    Outcome outcome = run_semview(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << arguments << '\n' << outcome.output;
    return outcome;
  }

  testing::TemporaryFolder folder_;
};

TEST_F(FusedMapTest, InfoAndCheckKnowTheVolume) {
  const auto info = nlohmann::json::parse(succeed("map info --json " + volume()).answer);
  EXPECT_EQ(info["kind"], "mesh");
  EXPECT_EQ(info["volume"]["voxel_m"], 0.05);
  EXPECT_EQ(info["volume"]["frames"], 21);
  EXPECT_EQ(info["volume"]["skipped"], 0);
  EXPECT_THAT(succeed("map info " + file("room")).output,
              HasSubstr("volume.vdb: voxels of 0.05 m, truncated at 0.2 m, 21 frames, 0 skipped"));
  EXPECT_THAT(succeed("map check " + volume()).output, HasSubstr("0 errors"));
  // The mesh is a map without it, too.
  std::filesystem::remove(volume());
  EXPECT_THAT(succeed("map info " + file("room")).output, HasSubstr("volume.vdb: no such file"));
}

TEST_F(FusedMapTest, ThePreviewShowsItsClassesFromAbove) {
  succeed("map preview " + volume() + " -o " + file("plan.png"));
  const auto picture = io::read_png_rgb(file("plan.png"));
  ASSERT_TRUE(picture);
  std::size_t brown = 0;
  for (const Rgb& pixel : picture->pixels()) brown += pixel == Rgb{150, 116, 84} ? 1 : 0;
  EXPECT_GT(brown, picture->pixels().size() / 50);  // floor
}

TEST_F(FusedMapTest, ViewsShowTheFloorBelowAndTheWallAhead) {
  succeed("view " + volume() + " --pose 0.3,-0.3,0 --eye-height 0.6 --labels " + file("view.png"));
  const auto labels = io::read_png_grey(file("view.png"));
  ASSERT_TRUE(labels);
  const auto info = nlohmann::json::parse(succeed("map info --json " + volume()).answer);
  const auto id_of = [&](const std::string& name) {
    for (const auto& entry : info["classes"]) {
      if (entry["name"] == name) return entry["id"].get<int>();
    }
    return -1;
  };
  const int middle = labels->columns() / 2;
  EXPECT_EQ(labels->at(labels->rows() - 8, middle), id_of("floor"));
  EXPECT_EQ(labels->at(labels->rows() / 2 - 5, middle), id_of("wall"));
}

TEST_F(FusedMapTest, ARobotIsSimulatedAndLocalizedInIt) {
  succeed("simulate " + volume() + " --out " + file("log") +
          " --steps 3 --frame-distance 0.1 --eye-height 0.6");
  const auto truth = io::read_tum(file("log/groundtruth.txt"));
  ASSERT_TRUE(truth);
  succeed("localize --log " + file("log") + " --map " + volume() +
          " --eye-height 0.6 --global --particles 200 -o " + file("est.tum"));
  EXPECT_TRUE(io::read_tum(file("est.tum")));
  EXPECT_THAT(succeed("locate " + volume() + " --obs " + file("log") +
                      " --frame 0 --eye-height 0.6 --top 1 --json")
                  .output,
              HasSubstr("yaw"));
}

TEST_F(FusedMapTest, ADepthCameraIsLocalizedInTheVolume) {
  succeed("simulate " + volume() + " --out " + file("drive") +
          " --steps 3 --frame-distance 0.1 --eye-height 0.6");
  const auto driven = io::read_run_log(folder_ / "drive");
  ASSERT_TRUE(driven) << driven.error().message;
  testing::record_depth_log(*driven, volume(), folder_ / "log");
  const Pose2 start = driven->groundtruth->front().pose;
  succeed("localize --log " + file("log") + " --map " + volume() +
          " --model sdf_sem --particles 300 --eye-height 0.6 -o " + file("est.tum") +
          fmt::format(" --init {},{},{},0.2", start.x_m, start.y_m, deg_from_rad(start.yaw_rad)));
  const auto estimate = io::read_tum(folder_ / "est.tum");
  ASSERT_TRUE(estimate && !estimate->empty());
  const auto truth = io::interpolate(*driven->groundtruth, estimate->back().stamp_s);
  ASSERT_TRUE(truth);
  EXPECT_LT(distance_m(estimate->back().pose, *truth), 0.3);
}

TEST_F(FusedMapTest, VdbPrintReadsTheVolume) {
  const Outcome print = run_command("vdb_print -l " + volume());
  if (print.exit_code == 127) GTEST_SKIP() << "libopenvdb-tools is not installed";
  ASSERT_EQ(print.exit_code, 0) << print.output;
  for (const char* text : {"Name: tsdf",
                           "Name: weight",
                           "Name: class",
                           "Name: count_floor",
                           "Name: colour",
                           "semview_frames: 21",
                           "semview_voxel_m: 0.05"}) {
    EXPECT_THAT(print.output, HasSubstr(text));
  }
}

}  // namespace
}  // namespace semview
