// SPDX-License-Identifier: Apache-2.0
#include "semview/io/observation_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/io/png.hpp"
#include "support/temporary_folder.hpp"

namespace semview::io {
namespace {

using semview::testing::TemporaryFolder;
using ::testing::HasSubstr;

const PanoramaCamera kProfile{120, 30, rad_from_deg(-45.0), rad_from_deg(45.0)};

ObservationSetup panorama_setup() {
  PartialPanorama camera;
  camera.position_m = {0.25, -0.1, 1.3};
  return {ClassTable({"wall", "floor: \"oak\"", "door"}), camera};
}

LabelImage striped_labels() {
  LabelImage labels(30, 120, 1);
  for (int c = 0; c < 120; ++c) labels.at(29, c) = 2;
  labels.at(3, 4) = kUnknown;
  return labels;
}

TEST(ObservationFolderTest, APanoramaComesBack) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_observation(folder / "obs", panorama_setup(), striped_labels(), 12.5));
  const Result<Observation> observation = read_observation(folder / "obs", kProfile);
  ASSERT_TRUE(observation) << observation.error().message;
  EXPECT_EQ(observation->labels, striped_labels());
  EXPECT_EQ(observation->classes, panorama_setup().classes);
  EXPECT_EQ(observation->stamp_s, 12.5);
  EXPECT_EQ(observation->base_from_eye, (Pose2{0.25, -0.1, 0.0}));
}

TEST(ObservationFolderTest, APinholeComesBackWithItsMount) {
  const TemporaryFolder folder;
  MountedPinhole mounted;
  mounted.camera = {160, 120, 80.5, 81.0, 79.5, 60.0};
  mounted.base_from_camera = level_camera({0.1, 0.2, rad_from_deg(-30.0)}, 0.9) *
                             Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX()) *
                             Eigen::AngleAxisd(-0.1, Eigen::Vector3d::UnitZ());
  const ObservationSetup setup{ClassTable({"wall"}), mounted};
  const Result<YamlNode> document = parse_yaml(format_observation_setup(setup), "observation.yaml");
  ASSERT_TRUE(document);
  const Result<ObservationSetup> read = parse_observation_setup(*document);
  ASSERT_TRUE(read) << read.error().message;
  const auto& again = std::get<MountedPinhole>(read->camera);
  EXPECT_EQ(again.camera, mounted.camera);
  EXPECT_TRUE(again.base_from_camera.isApprox(mounted.base_from_camera, 1e-9));
}

TEST(ObservationSetupTest, ZeroAnglesMeanLevelAndAhead) {
  const YamlNode document = *parse_yaml(
      "format: 1\nclasses: [a]\npinhole: {width: 4, height: 4, fx: 2, fy: 2, cx: 2, cy: 2}\n"
      "base_from_camera: {x: 0.1, z: 1.0, yaw_deg: 90}\n",
      "o.yaml");
  const Result<ObservationSetup> setup = parse_observation_setup(document);
  ASSERT_TRUE(setup) << setup.error().message;
  // Turned left by 90°: looks along y of the robot.
  EXPECT_TRUE(std::get<MountedPinhole>(setup->camera)
                  .base_from_camera.isApprox(level_camera({0.1, 0.0, kPi / 2.0}, 1.0), 1e-12));
}

std::string setup_error(const std::string& text) {
  const Result<YamlNode> document = parse_yaml(text, "o.yaml");
  const Result<ObservationSetup> setup = parse_observation_setup(*document);
  return setup ? "no error" : setup.error().message;
}

TEST(ObservationSetupTest, FaultsNameFileAndLine) {
  const std::string good = "format: 1\nclasses: [a, b]\npanorama:\n";
  const std::string range = "  elevation_min_deg: -45\n  elevation_max_deg: 45\n";
  EXPECT_EQ(setup_error(good + range), "no error");
  EXPECT_THAT(setup_error(good + "  elevation_min_deg: -45\n"),
              HasSubstr("key 'elevation_max_deg' is missing"));
  EXPECT_THAT(setup_error(good + range + "  azimuth: 3\n"), HasSubstr("o.yaml:6: unknown key"));
  EXPECT_THAT(setup_error(good + range + "  azimuth_left_deg: -181\n"), HasSubstr("must decrease"));
  EXPECT_THAT(setup_error(good + range + "base_from_camera: {yaw_deg: 90}\n"),
              HasSubstr("must be 0"));
  EXPECT_THAT(setup_error("format: 2\n"), HasSubstr("o.yaml:1: format 2, this version reads 1"));
  EXPECT_THAT(setup_error("format: 1\nclasses: [a, b, a]\n"),
              HasSubstr("o.yaml:2: class 'a' twice"));
  EXPECT_THAT(setup_error("format: 1\nclasses: []\n"), HasSubstr("0 classes, expected 1 to 254"));
  EXPECT_THAT(setup_error("format: 1\nclasses: [a]\n"),
              HasSubstr("either 'panorama' or 'pinhole'"));
  EXPECT_THAT(setup_error("format: 1\nclasses: [a]\npinhole: {width: 0, height: 1, fx: 1, fy: 1, "
                          "cx: 0, cy: 0}\n"),
              HasSubstr("o.yaml:3: width 0, expected 1 to 20000"));
  EXPECT_THAT(setup_error("format: 1\nclasses: [a]\npinhole: {width: 1, height: 1, fx: -1, fy: 1, "
                          "cx: 0, cy: 0}\n"),
              HasSubstr("o.yaml:3: fx -1"));
}

TEST(ObservationFolderTest, AnIdPastTheClassesNamesItsPixel) {
  const TemporaryFolder folder;
  LabelImage labels = striped_labels();
  labels.at(2, 7) = 4;
  ASSERT_TRUE(write_observation(folder / "obs", panorama_setup(), labels, 0.0));
  const Result<Observation> observation = read_observation(folder / "obs", kProfile);
  ASSERT_FALSE(observation);
  EXPECT_THAT(observation.error().message, HasSubstr("row 2, column 7 has id 4, expected up to 3"));
}

TEST(ObservationFolderTest, APinholeImageMustHaveTheCamerasSize) {
  const TemporaryFolder folder;
  MountedPinhole mounted;
  mounted.camera = {4, 3, 2.0, 2.0, 2.0, 1.5};
  const ObservationSetup setup{ClassTable({"wall"}), mounted};
  EXPECT_EQ(write_observation(folder / "obs", setup, LabelImage(4, 4, 1), 0.0).error().code,
            ErrorCode::kInvalidArgument);
  ASSERT_TRUE(write_observation(folder / "obs", setup, LabelImage(3, 4, 1), 0.0));
  ASSERT_TRUE(write_png(folder / "obs/labels.png", LabelImage(3, 5, 1)));
  EXPECT_THAT(read_observation(folder / "obs", kProfile).error().message,
              HasSubstr("5 x 3 pixels, expected the pinhole camera's 4 x 3"));
}

TEST(ObservationFolderTest, AMissingFileIsNotFound) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_observation(folder / "obs", kProfile).error().code, ErrorCode::kNotFound);
  ASSERT_TRUE(write_observation(folder / "obs", panorama_setup(), striped_labels(), 0.0));
  std::filesystem::remove(folder / "obs/labels.png");
  EXPECT_EQ(read_observation(folder / "obs", kProfile).error().code, ErrorCode::kNotFound);
}

TEST(ObservationFolderTest, ConfidenceIsReadWithTheLabels) {
  const TemporaryFolder folder;
  // Two source pixels a profile pixel and side: of the four, three are wall, 200 sure each.
  LabelImage labels(60, 240, 1);
  Image<std::uint8_t> confidence(60, 240, 200);
  labels.at(0, 0) = 2;
  labels.at(10, 10) = labels.at(10, 11) = labels.at(11, 10) = labels.at(11, 11) = kUnknown;
  ASSERT_TRUE(write_observation(folder / "obs", panorama_setup(), labels, 0.0, confidence));
  const Result<Observation> observation = read_observation(folder / "obs", kProfile);
  ASSERT_TRUE(observation) << observation.error().message;
  EXPECT_EQ(observation->confidence.at(0, 0), 150);
  EXPECT_EQ(observation->confidence.at(1, 1), 200);
  EXPECT_EQ(observation->confidence.at(5, 5), 0);
  // Written anew without, none is left behind.
  ASSERT_TRUE(write_observation(folder / "obs", panorama_setup(), labels, 0.0));
  EXPECT_TRUE(read_observation(folder / "obs", kProfile)->confidence.empty());
}

TEST(ObservationFolderTest, AConfidenceOfAnotherSizeIsAnError) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_observation(folder / "obs", panorama_setup(), striped_labels(), 0.0));
  ASSERT_TRUE(write_png(folder / "obs/confidence.png", Image<std::uint8_t>(30, 119, 1)));
  EXPECT_THAT(read_observation(folder / "obs", kProfile).error().message,
              HasSubstr("119 x 30 pixels, expected the 120 x 30 of labels.png"));
}

}  // namespace
}  // namespace semview::io
