// SPDX-License-Identifier: Apache-2.0
// `semview fuse` as a person or script calls it.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/field/vdb_file.hpp"
#include "semview/io/png.hpp"
#include "semview/map/semantic_map.hpp"
#include "support/child_process.hpp"
#include "support/paths.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace semview {
namespace {

using semview::testing::Outcome;
using semview::testing::run_semview;
using ::testing::HasSubstr;

// Rendered depths (Redwood's living room), labels that a network predicted: see SOURCE.md there.
const std::string kRoom = SEMVIEW_SOURCE_DIR "/tests/data/rgbd_livingroom1";
// Depths of a real camera.
const std::string kRealRoom = SEMVIEW_SOURCE_DIR "/tests/data/rgbd_dining_room";

class FuseProgramTest : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// A log of `frames` images of a red wall 2 m ahead of a level camera that does not move.
  void write_wall_log(int frames) {
    folder_.write("log/log.yaml",
                  "format: 1\n"
                  "pinhole: {width: 40, height: 30, fx: 32, fy: 32, cx: 20, cy: 15}\n"
                  "base_from_camera: {x: 0, y: 0, z: 0, roll_deg: 0, pitch_deg: 0, yaw_deg: 0}\n"
                  "classes: [wall, coffee table]\n");
    std::string lines = "timestamp,labels,depth,image\n";
    for (int i = 0; i < frames; ++i) {
      lines += fmt::format("{},,depth/{}.png,images/{}.png\n", i, i, i);
      std::filesystem::create_directories(folder_ / "log/depth");
      std::filesystem::create_directories(folder_ / "log/images");
      write_depth(i, Image<std::uint16_t>(30, 40, 2000));
      ASSERT_TRUE(
          io::write_png(folder_ / fmt::format("log/images/{}.png", i), RgbImage(30, 40, kRed)));
    }
    folder_.write("log/frames.csv", lines);
    folder_.write("log/odometry.txt", "0 0 0 0 0 0 0 1\n");
    write_poses(frames);
  }
  void write_poses(int frames) {
    std::string lines;
    for (int i = 0; i < frames; ++i) lines += fmt::format("{} 0 0 0 0 0 0 1\n", i);
    folder_.write("log/poses.txt", lines);
  }
  void write_depth(int frame, const Image<std::uint16_t>& depth) {
    ASSERT_TRUE(io::write_png(folder_ / fmt::format("log/depth/{}.png", frame), depth));
  }
  Outcome fuse(const std::string& options = {}) const {
    return run_semview("fuse " + file("log") + " -o " + file("out") + " --up -y " + options);
  }
  /// Of the voxel at the wall, left or right of the middle.
  ClassId class_at(double y_m) const {
    const auto stored = field::read_vdb(folder_ / "out/volume.vdb");
    EXPECT_TRUE(stored) << stored.error().message;
    return stored->volume.most_likely_class(stored->volume.voxel_at({2.01, y_m, 0.1}));
  }

  static constexpr Rgb kRed{200, 10, 10};
  testing::TemporaryFolder folder_;
};

TEST_F(FuseProgramTest, MakesAVolumeThatIsAMapAndKeepsItsColours) {
  write_wall_log(3);
  const Outcome outcome = fuse();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("0 of 3 frames skipped"));
  const auto stored = field::read_vdb(folder_ / "out/volume.vdb");
  ASSERT_TRUE(stored) << stored.error().message;
  const field::VoxelIndex voxel = stored->volume.voxel_at({2.01, 0.2, 0.1});
  EXPECT_EQ(stored->volume.weight(voxel), 3.0F);
  const field::VoxelBlock* block = stored->volume.block(field::SemanticVolume::block_of(voxel));
  ASSERT_NE(block, nullptr);
  EXPECT_NEAR(block->colour[field::SemanticVolume::place_in_block(voxel)].x(), float{kRed.r}, 1e-3);
  // By its folder and by its volume.
  for (const char* name : {"out", "out/volume.vdb"}) {
    const auto map = map::load_map(folder_ / name);
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_EQ(map->volume, folder_ / "out/volume.vdb");
  }
}

TEST_F(FuseProgramTest, FramesThatCannotBeUsedAreSkippedWithALineEachAndCounted) {
  write_wall_log(9);
  write_depth(2, Image<std::uint16_t>(15, 20, 2000));
  write_depth(3, Image<std::uint16_t>(30, 40, 0));
  folder_.write("log/depth/4.png", "no picture");
  std::filesystem::remove(folder_ / "log/depth/5.png");
  ASSERT_TRUE(io::write_png(folder_ / "log/images/6.png", RgbImage(3, 4, kRed)));
  folder_.write("log/poses.txt",
                "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n3 0 0 0 0 0 0 1\n"
                "4 0 0 0 0 0 0 1\n5 0 0 0 0 0 0 1\n6 0 0 0 0 0 0 1\n7 nan 0 0 0 0 0 1\n");
  const Outcome outcome = fuse();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  for (const char* line : {"frame 2 skipped: depth of 20 x 15 pixels, the camera has 40 x 30",
                           "frame 3 skipped: no depth between 0.1 and 5 m",
                           "frame 4 skipped: ",
                           "frame 5 skipped: ",
                           "frame 6 skipped: colour of 4 x 3 pixels",
                           "frame 7 skipped: no pose at 7.000000000 s: the trajectory was lost",
                           "frame 8 skipped: no pose at 8.000000000 s: outside the trajectory",
                           "7 of 9 frames skipped"}) {
    EXPECT_THAT(outcome.output, HasSubstr(line));
  }
  EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 9 + 1) << outcome.output;
}

TEST_F(FuseProgramTest, AnotherMapOrVolumeIsNotWrittenOver) {
  write_wall_log(2);
  const std::string foreign = "semview: {format: 1, labels: plan.png}\n";
  folder_.write("out/map.yaml", foreign);
  Outcome outcome = fuse();
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("map.yaml: is a map that is not of volume.vdb"));
  EXPECT_EQ(semview::testing::file_bytes(folder_ / "out/map.yaml"), foreign);
  std::filesystem::remove(folder_ / "out/map.yaml");

  ASSERT_EQ(fuse().exit_code, 0);
  outcome = fuse("--max-depth 3");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("volume.vdb: holds another fusion"));
  EXPECT_EQ(fuse().exit_code, 0);
}

TEST_F(FuseProgramTest, InstanceMasksAreFlattenedByScore) {
  write_wall_log(2);
  Image<std::uint8_t> all(30, 40, 255);
  Image<std::uint8_t> right(30, 40);
  for (int r = 0; r < 30; ++r) {
    for (int c = 20; c < 40; ++c) right.at(r, c) = 1;
  }
  std::filesystem::create_directories(folder_ / "masks");
  ASSERT_TRUE(io::write_png(folder_ / "masks/all.png", all));
  ASSERT_TRUE(io::write_png(folder_ / "masks/right.png", right));
  for (const char* list : {"masks/0.csv", "masks/1.csv"}) {
    folder_.write(list, "mask,class,score\nall.png,wall,0.4\nright.png,coffee table,0.8\n");
  }
  const Outcome outcome = fuse("--labels " + file("masks"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(class_at(0.5), 1);
  EXPECT_EQ(class_at(-0.5), 2);
}

TEST_F(FuseProgramTest, WhatCannotBeginSaysWhyInOneLine) {
  write_wall_log(2);
  for (const auto& [options, reason] :
       {std::pair{"--labels " + file("none"), "no such folder"},
        std::pair{std::string("--voxel 7"), "voxel of 7 m: expected 0.005 to 1"},
        std::pair{std::string("--poses nowhere.txt"), "nowhere.txt"},
        std::pair{std::string("--up 1,2"), "--up"},
        std::pair{std::string("--truncation 0.01"), "truncation distance of 0.01 m"}}) {
    const Outcome outcome = fuse(options);
    EXPECT_NE(outcome.exit_code, 0) << options;
    EXPECT_THAT(outcome.output, HasSubstr(reason));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out/volume.vdb"));
  }
}

TEST_F(FuseProgramTest, AFusionThatWasStoppedGoesOnToTheSameVolume) {
  const std::string arguments = "fuse " + kRoom + " --up -y -o ";
  ASSERT_EQ(run_semview(arguments + file("whole")).exit_code, 0);
  testing::ChildProcess child(
      "semview", {"fuse", kRoom, "--up", "-y", "-o", file("out")}, folder_ / "log");
  child.says("frames");
  child.signal(SIGINT);
  // It may have been done before.
  const int code = child.wait();
  EXPECT_TRUE(code == 0 || code == 1) << child.errors();
  if (code == 1) {
    EXPECT_THAT(child.errors(), HasSubstr("run the same command again to go on"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out/map.yaml"));
    // Not a map yet, and it says why.
    const auto map = map::load_map(folder_ / "out/volume.vdb");
    ASSERT_FALSE(map);
    EXPECT_THAT(map.error().message, HasSubstr("no map.yaml beside it names it"));
  }
  const Outcome outcome = run_semview(arguments + file("out"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const auto whole = field::read_vdb(folder_ / "whole/volume.vdb");
  const auto resumed = field::read_vdb(folder_ / "out/volume.vdb");
  ASSERT_TRUE(whole && resumed);
  EXPECT_EQ(resumed->frames, whole->frames);
  ASSERT_EQ(resumed->volume.block_indices(), whole->volume.block_indices());
  for (const field::VoxelIndex& index : whole->volume.block_indices()) {
    EXPECT_EQ(resumed->volume.block(index)->sdf_m, whole->volume.block(index)->sdf_m);
    EXPECT_EQ(resumed->volume.block(index)->weight, whole->volume.block(index)->weight);
  }
  EXPECT_EQ(semview::testing::file_bytes(folder_ / "out/mesh.glb"),
            semview::testing::file_bytes(folder_ / "whole/mesh.glb"));
}

TEST_F(FuseProgramTest, ARealLogBecomesARoomWithItsFloorWhereItIs) {
  const Outcome outcome = run_semview("fuse " + kRoom + " -o " + file("room") + " --up -y");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const auto map = map::load_map(folder_ / "room");
  ASSERT_TRUE(map) << map.error().message;
  // The camera of the first frame, which is the origin, was carried 0.41 m above the carpet: the
  // lowest row of its depth image is a level plane at y = 0.409 to 0.418.
  EXPECT_NEAR(map->ground_height_m, -0.41, 0.015);
  EXPECT_EQ(map->classes.name(map->ground_label), "floor");
  EXPECT_GT(map->mesh()->mesh.triangles.size(), 5000U);
}

/// Median depth error of frames left out, of what `semview fuse` says, mm.
double median_error_mm(const std::string& output) {
  const std::string before = "median depth error ";
  const std::size_t at = output.find(before);
  return at == std::string::npos ? NAN : std::stod(output.substr(at + before.size()));
}

TEST_F(FuseProgramTest, FramesLeftOutAreSeenByTheMapWithinAVoxel) {
  const Outcome rendered =
      run_semview("fuse " + kRoom + " -o " + file("room") + " --up -y --check-every 5");
  ASSERT_EQ(rendered.exit_code, 0) << rendered.output;
  EXPECT_THAT(rendered.output, HasSubstr("left out 4 frames"));
  EXPECT_LT(median_error_mm(rendered.output), 50.0);
  const Outcome real = run_semview("fuse " + kRealRoom + " -o " + file("real") +
                                   " --up -y --min-frames 1 --check-every 5");
  ASSERT_EQ(real.exit_code, 0) << real.output;
  EXPECT_THAT(real.output, HasSubstr("left out 1 frame:"));
  EXPECT_LT(median_error_mm(real.output), 50.0);
}

}  // namespace
}  // namespace semview
