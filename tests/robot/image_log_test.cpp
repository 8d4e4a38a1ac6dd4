// SPDX-License-Identifier: Apache-2.0
// `semview localize --segment`: a run log of camera images ends where the same log of labels does.
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "segmentation/colour_network.hpp"
#include "semview/io/png.hpp"
#include "semview/io/run_log.hpp"
#include "semview/io/trajectory.hpp"
#include "support/semview_runs.hpp"

namespace semview {
namespace {

using segmentation::testing::colour_of_channel;
using ::testing::HasSubstr;

const std::string kMap = SEMVIEW_SOURCE_DIR "/maps/duplex_level1";

class ImageLogTest : public testing::SemviewRuns {
 protected:
  /// A simulated drive, and the same with pictures in the labels' place: each class in a colour
  /// that the network knows.
  void make_logs() {
    ASSERT_EQ(run({"simulate", kMap, "--out", file("labels_log"), "--seed", "3", "--steps", "4"}),
              0)
        << errors_;
    const io::RunLog log = *io::read_run_log(file("labels_log"));
    for (const std::string& name : log.setup.classes.names()) names_.push_back(name);
    const std::filesystem::path images(file("image_log"));
    std::filesystem::create_directories(images / "images");
    std::string frames = "timestamp,labels,depth,image\n";
    for (std::size_t i = 0; i < log.frames.size(); ++i) {
      const Image<std::uint8_t> labels = *io::read_png_grey(log.directory / log.frames[i].labels);
      RgbImage picture(labels.rows(), labels.columns());
      for (std::size_t k = 0; k < labels.pixels().size(); ++k) {
        const int id = labels.pixels()[k];
        picture.pixels()[k] = id >= 1 && id <= log.setup.classes.size() ? colour_of_channel(id - 1)
                                                                        : Rgb{128, 128, 128};
      }
      const std::string name = fmt::format("images/{:06}.png", i);
      ASSERT_TRUE(io::write_png(images / name, picture));
      frames += fmt::format("{:.9f},,,{}\n", log.frames[i].stamp_s, name);
    }
    folder_.write("image_log/frames.csv", frames);
    folder_.write("image_log/odometry.txt", testing::file_bytes(log.directory / "odometry.txt"));
    folder_.write("image_log/log.yaml",
                  "format: 1\npanorama: {elevation_min_deg: -45, elevation_max_deg: 45}\n");
    const Pose2 start = log.groundtruth->front().pose;
    truth_ = log.groundtruth->back().pose;
    init_ =
        fmt::format("{:.3f},{:.3f},{:.1f},0.2", start.x_m, start.y_m, deg_from_rad(start.yaw_rad));
  }

  testing::Arguments localize(const std::string& log) const {
    return {"localize",
            "--log",
            file(log),
            "--map",
            kMap,
            "--init",
            init_,
            "--particles",
            "100",
            "-o",
            file("est.tum")};
  }

  std::vector<std::string> names_;
  std::string init_;
  Pose2 truth_;
};

TEST_F(ImageLogTest, TheRobotEndsWhereItsLabelsWouldHavePutIt) {
  make_logs();
  const auto network =
      segmentation::testing::write_colour_network(folder_, names_, 256, 200.0).string();
  testing::Arguments arguments = localize("image_log");
  arguments.insert(arguments.end(), {"--segment", network});
  ASSERT_EQ(run(arguments), 0) << errors_;
  EXPECT_THAT(output_, HasSubstr("4 frames, 4 scored"));
  const Pose2 end = io::read_tum(file("est.tum"))->back().pose;
  EXPECT_LT(distance_m(end, truth_), 0.35);

  EXPECT_EQ(run(localize("image_log")), 2);
  EXPECT_THAT(errors_, HasSubstr("holds images and no labels; expected --segment"));
  arguments = localize("labels_log");
  arguments.insert(arguments.end(), {"--segment", network});
  EXPECT_EQ(run(arguments), 2);
  EXPECT_THAT(errors_, HasSubstr("holds no images"));
}

}  // namespace
}  // namespace semview
