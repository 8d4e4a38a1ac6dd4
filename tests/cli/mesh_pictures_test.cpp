// SPDX-License-Identifier: Apache-2.0
// A mesh has no drawing: pictures show its free cells in the place of one.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/io/png.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace semview {
namespace {

using semview::testing::Outcome;
using semview::testing::run_semview;
using ::testing::HasSubstr;

class MeshPicturesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const Outcome made = run_semview("map export " SEMVIEW_SOURCE_DIR "/maps/tutorial " + mesh());
    ASSERT_EQ(made.exit_code, 0) << made.output;
  }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string mesh() const { return file("house.glb"); }

  semview::testing::TemporaryFolder folder_;
};

TEST_F(MeshPicturesTest, ThePreviewShowsTheFreeCells) {
  const Outcome run = run_semview("map preview " + mesh() + " -o " + file("plan.png"));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const auto picture = io::read_png_rgb(file("plan.png"));
  ASSERT_TRUE(picture);
  std::size_t free = 0;
  for (const Rgb& pixel : picture->pixels()) free += pixel == Rgb{226, 221, 208} ? 1 : 0;
  EXPECT_GT(free, picture->pixels().size() / 20);
}

TEST_F(MeshPicturesTest, TracksAreDrawnOnTheFreeCells) {
  const Outcome drive =
      run_semview("simulate " SEMVIEW_SOURCE_DIR "/maps/tutorial --steps 3 --out " + file("log"));
  ASSERT_EQ(drive.exit_code, 0) << drive.output;
  const Outcome run =
      run_semview("evaluate run --log " + file("log") + " " + file("log/groundtruth.txt") +
                  " --map " + mesh() + " --svg " + file("tracks.svg"));
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(semview::testing::file_bytes(file("tracks.svg")), HasSubstr("<image"));
}

TEST_F(MeshPicturesTest, AnOccupancyImageIsRefusedWithTheReason) {
  const Outcome run = run_semview("map occupancy " + mesh() + " -o " + file("o.png"));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.output, HasSubstr("is a mesh map, which has no drawing"));
  EXPECT_THAT(run.output, HasSubstr("map preview"));
}

}  // namespace
}  // namespace semview
