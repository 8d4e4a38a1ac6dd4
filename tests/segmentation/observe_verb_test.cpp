// SPDX-License-Identifier: Apache-2.0
// `semview observe` as a person or script calls it.
#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "segmentation/colour_network.hpp"
#include "semview/io/observation_folder.hpp"
#include "semview/io/png.hpp"
#include "support/jpeg_file.hpp"
#include "support/semview_runs.hpp"

namespace semview {
namespace {

using segmentation::testing::colour_of_channel;
using ::testing::HasSubstr;
using ::testing::Not;

const PanoramaCamera kProfile{360, 90, -kPi / 4.0, kPi / 4.0};

/// The names that a matrix of the 150 classes of ADE20K knows.
std::vector<std::string> ade20k150_names() {
  std::vector<std::string> names;
  std::ifstream file(SEMVIEW_SOURCE_DIR "/vocabularies/ade20k150/names.tsv");
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line.front() != '#') names.push_back(line.substr(0, line.find('\t')));
  }
  return names;
}

class ObserveVerbTest : public testing::SemviewRuns {
 protected:
  /// A photograph of class `above` (from 0) over class `below`.
  std::string photo(
      const std::string& name, int above, int below, int rows = 128, int columns = 256) {
    RgbImage image(rows, columns, colour_of_channel(above));
    for (int r = rows / 2; r < rows; ++r) {
      for (Rgb& pixel : image.row(r)) pixel = colour_of_channel(below);
    }
    return folder_.write(name, testing::jpeg_bytes(image)).string();
  }
  std::string network(const std::vector<std::string>& names) {
    return segmentation::testing::write_colour_network(folder_, names, 64, 200.0).string();
  }
  Observation observation() {
    Result<Observation> read = io::read_observation(file("obs"), kProfile);
    EXPECT_TRUE(read) << read.error().message;
    return *read;
  }
};

TEST_F(ObserveVerbTest, APhotographIsScoredWithAMatrixOf150ClassesByName) {
  const std::vector<std::string> names = ade20k150_names();
  ASSERT_EQ(names.size(), 150U);
  ASSERT_EQ(run({"observe",
                 photo("room.jpg", 0, 3),
                 "--equirectangular",
                 "--model",
                 network(names),
                 "-o",
                 file("obs"),
                 "--overlay",
                 file("overlay.png"),
                 "--stamp",
                 "2.5",
                 "--json"}),
            0)
      << errors_;
  const auto summary = nlohmann::json::parse(output_);
  EXPECT_EQ(summary["columns"], 720);
  EXPECT_NEAR(summary["seen_width_deg"].get<double>(), 360.0, 1e-6);
  EXPECT_GT(summary["class_shares"]["wall"].get<double>(), 0.4);
  EXPECT_GT(summary["class_shares"]["floor"].get<double>(), 0.4);
  const Observation seen = observation();
  EXPECT_EQ(seen.stamp_s, 2.5);
  EXPECT_EQ(seen.classes.size(), 150);
  EXPECT_EQ(seen.classes.name(seen.labels.at(20, 100)), "wall");
  EXPECT_EQ(seen.classes.name(seen.labels.at(70, 100)), "floor");
  EXPECT_EQ(seen.confidence.rows(), 90);
  EXPECT_GT(seen.confidence.at(20, 100), 200);
  EXPECT_GT(io::png_size(file("overlay.png"))->columns, 1000);
  const std::string map = SEMVIEW_SOURCE_DIR "/maps/duplex_level1";
  EXPECT_EQ(run({"score",
                 map,
                 "--obs",
                 file("obs"),
                 "--weights",
                 map + "/weights.csv",
                 "--pose",
                 "4.5,-13.2,0"}),
            0)
      << errors_;
}

TEST_F(ObserveVerbTest, ARigOfSeveralImagesBecomesOnePanorama) {
  const std::string rig =
      "format: 1\ncameras:\n"
      "  - pinhole: {width: 100, height: 80, fx: 50, fy: 50, cx: 50, cy: 40}\n"
      "    base_from_camera: {x: 0.2, z: 1.0, yaw_deg: 45}\n"
      "  - pinhole: {width: 100, height: 80, fx: 50, fy: 50, cx: 50, cy: 40}\n"
      "    base_from_camera: {x: 0.2, z: 1.0, yaw_deg: -45}\n";
  ASSERT_EQ(run({"observe",
                 photo("left.jpg", 1, 1, 80, 100),
                 photo("right.jpg", 2, 2, 80, 100),
                 "--camera",
                 folder_.write("rig.yaml", rig).string(),
                 "--model",
                 network({"a", "b", "c"}),
                 "-o",
                 file("obs")}),
            0)
      << errors_;
  EXPECT_THAT(output_, HasSubstr("180 deg of it seen"));
  EXPECT_THAT(errors_, HasSubstr("labelling picture 2 of 2"));
  const Observation seen = observation();
  EXPECT_EQ(seen.base_from_eye, (Pose2{0.2, 0.0, 0.0}));
  EXPECT_EQ(seen.labels.at(45, 180 - 45), 2);
  EXPECT_EQ(seen.labels.at(45, 180 + 45), 3);
  EXPECT_EQ(seen.labels.at(45, 10), kUnknown);
}

TEST_F(ObserveVerbTest, AnOrdinaryPhotographIsNoWholeSphere) {
  LabelImage labels(48, 64, 1);
  ASSERT_TRUE(io::write_png(file("photo.png"), labels));
  EXPECT_EQ(run({"observe",
                 file("photo.png"),
                 "--equirectangular",
                 "--labels",
                 "--classes",
                 "ade20k150",
                 "-o",
                 file("obs")}),
            1);
  EXPECT_THAT(errors_, HasSubstr("photo.png: 64 x 48 pixels, expected twice as wide as high"));
  EXPECT_THAT(errors_, HasSubstr("--camera RIG.yaml"));
  EXPECT_FALSE(std::filesystem::exists(file("obs")));
}

TEST_F(ObserveVerbTest, LabelsOfAnotherProgramEnterByName) {
  LabelImage labels(90, 180, 0);
  for (int r = 45; r < 90; ++r) {
    for (ClassId& label : labels.row(r)) label = 4;
  }
  labels.at(0, 0) = 255;
  ASSERT_TRUE(io::write_png(file("ids.png"), labels));
  const testing::Arguments common{"observe",
                                  file("ids.png"),
                                  "--equirectangular",
                                  "--labels",
                                  "--classes",
                                  "ade20k150",
                                  "-o",
                                  file("obs")};
  ASSERT_EQ(run(common), 0) << errors_;
  EXPECT_EQ(observation().labels.at(20, 50), kUnknown);
  EXPECT_EQ(observation().classes.name(observation().labels.at(80, 50)), "floor");
  testing::Arguments from_zero = common;
  from_zero.insert(from_zero.end(), {"--first-value", "0", "--overlay", file("overlay.png")});
  ASSERT_EQ(run(from_zero), 0) << errors_;
  EXPECT_EQ(observation().classes.name(observation().labels.at(20, 50)), "wall");
  EXPECT_EQ(observation().classes.name(observation().labels.at(80, 50)), "tree");
  labels.at(3, 5) = 200;
  ASSERT_TRUE(io::write_png(file("ids.png"), labels));
  EXPECT_EQ(run(common), 1);
  EXPECT_THAT(errors_, HasSubstr("row 3, column 5 is 200, expected 1 to 150 (150 classes) or 255"));
}

TEST_F(ObserveVerbTest, WrongUseIsSaidInOneLine) {
  const std::string room = photo("room.jpg", 0, 1);
  EXPECT_EQ(run({"observe", room, "-o", file("obs")}), 2);
  EXPECT_THAT(errors_, HasSubstr("--camera: expected what took the images"));
  EXPECT_EQ(run({"observe", room, room, "--equirectangular", "-o", file("obs")}), 2);
  EXPECT_THAT(errors_, HasSubstr("IMAGE: 2 given, expected 1 with --equirectangular"));
  EXPECT_EQ(run({"observe", room, "--equirectangular", "--labels", "-o", file("obs")}), 2);
  EXPECT_THAT(errors_, HasSubstr("--classes: expected with --labels"));
  EXPECT_EQ(run({"observe", room, "--equirectangular", "--model", "nosuch", "-o", file("obs")}), 1);
  EXPECT_THAT(errors_, HasSubstr("nosuch: no such model"));
  EXPECT_THAT(errors_, HasSubstr("there: deeplab_ade20k32"));
  EXPECT_EQ(run({"observe",
                 folder_.write("x.jpg", "x").string(),
                 "--equirectangular",
                 "--model",
                 network({"a", "b"}),
                 "-o",
                 file("obs")}),
            1);
  EXPECT_THAT(errors_, HasSubstr("x.jpg: is neither a PNG nor a JPEG file"));
  EXPECT_FALSE(std::filesystem::exists(file("obs")));
  EXPECT_EQ(run({"observe", room, "--equirectangular", "--columns", "7", "-o", file("obs")}), 2);
  EXPECT_THAT(errors_, HasSubstr("--columns: 7 columns"));
}

TEST_F(ObserveVerbTest, NothingOfThePersonsIsWrittenOver) {
  const std::string room = photo("room.png", 0, 1);
  const auto observe = [&](const testing::Arguments& more) {
    testing::Arguments all{"observe", room, "--equirectangular"};
    all.insert(all.end(), more.begin(), more.end());
    EXPECT_EQ(run(all), 1) << output_;
  };
  observe({"-o", file("obs"), "--overlay", room});
  EXPECT_THAT(errors_, HasSubstr("room.png: is read as input, and would be written over"));
  std::filesystem::create_directory(folder_ / "map");
  folder_.write("map/map.yaml", "image: x");
  observe({"-o", file("map")});
  EXPECT_THAT(errors_, HasSubstr("map: has map.yaml, expected a new or empty folder"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "map" / "labels.png"));
}

}  // namespace
}  // namespace semview
