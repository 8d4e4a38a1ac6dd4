// SPDX-License-Identifier: Apache-2.0
// What is wrong with the drawing: its colours, the image itself, the free space in it.
#include <array>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include "map/map_checker_fixture.hpp"
#include "semview/io/png.hpp"

namespace semview::map {
namespace {

using testing::drawing;
using ::testing::HasSubstr;
using testing::map_yaml;
using testing::replaced;
using testing::room;
using testing::write_bundle;
using testing::write_text;

TEST_F(MapCheckerTest, UnknownColoursHaveCountFirstPixelAndNearestClass) {
  std::vector<std::string> rows = room();
  rows[3][4] = '?';
  rows[6][2] = '?';
  const MapProblem problem = only(check(map_yaml(), rows), Severity::kError);
  EXPECT_EQ(problem.file.filename(), "labels.png");
  EXPECT_EQ(problem.pixel, (PixelIndex{3, 4}));
  const std::string text = to_string(problem);
  EXPECT_THAT(text, HasSubstr("pixel (x 4, y 3)"));
  EXPECT_THAT(text, HasSubstr("[1, 2, 3]"));
  EXPECT_THAT(text, HasSubstr("2 pixels"));
  EXPECT_THAT(text, HasSubstr("nearest: outside [0, 0, 0]"));
}

TEST_F(MapCheckerTest, ManyUnknownColoursAreSummedUp) {
  write_bundle(folder_.path(), room(), map_yaml());
  RgbImage labels = drawing(room());
  for (int i = 0; i < 40; ++i) {
    labels.at(2 + i / 8, 2 + i % 8) = {121, static_cast<unsigned char>(i), 9};
  }
  ASSERT_TRUE(io::write_png(folder_ / "labels.png", labels));
  const MapReport report = check_map(folder_.path()).report;
  EXPECT_LT(report.problems.size(), 20U);
  EXPECT_THAT(to_string(report.problems.back()), HasSubstr("--nearest-colour"));
}

TEST_F(MapCheckerTest, NearestColourTakesThemAndWarns) {
  std::vector<std::string> rows = room();
  rows[0][0] = '?';
  CheckOptions options;
  options.load.nearest_colour = true;
  const MapCheck result = check(map_yaml(), rows, options);
  EXPECT_THAT(to_string(only(result, Severity::kWarning)), HasSubstr("1 pixels of 1 colours"));
  EXPECT_EQ(result.map->columns()->profile_of_pixel.at(0, 0), 0);
}

TEST_F(MapCheckerTest, MissingOrUnreadableImage) {
  write_text(folder_ / "map.yaml", map_yaml());
  const MapProblem missing = only(check_map(folder_.path()), Severity::kError);
  EXPECT_EQ(missing.file.filename(), "labels.png");
  EXPECT_EQ(missing.code, ErrorCode::kNotFound);
  EXPECT_THAT(missing.remedy, HasSubstr("draw the plan as a PNG there"));

  write_text(folder_ / "labels.png", "this is no picture");
  const MapProblem unreadable = only(check_map(folder_.path()), Severity::kError);
  EXPECT_EQ(unreadable.file.filename(), "labels.png");
}

TEST_F(MapCheckerTest, TransparentPixelsHaveCountAndFirstPixel) {
  // Grey and alpha, 2 x 2 pixels, of which (1, 0) and (0, 1) are not opaque.
  const std::array<png_byte, 8> samples{0, 255, 0, 0, 0, 127, 0, 255};
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 2;
  image.height = 2;
  image.format = PNG_FORMAT_GA;
  write_text(folder_ / "map.yaml", map_yaml());
  ASSERT_NE(png_image_write_to_file(
                &image, (folder_ / "labels.png").c_str(), 0, samples.data(), 0, nullptr),
            0);
  const MapProblem problem = only(check_map(folder_.path()), Severity::kError);
  EXPECT_THAT(to_string(problem),
              HasSubstr("labels.png: pixel (x 1, y 0): error: 2 pixels are transparent"));
}

TEST_F(MapCheckerTest, ProblemsOfFileAndImageAreListedTogether) {
  std::vector<std::string> rows = room();
  rows[3][4] = '?';
  const MapCheck result = check(replaced(map_yaml(), "min_height: 0.7,", "min_height: 2.4,"), rows);
  EXPECT_EQ(result.report.count(Severity::kError), 2U);
}

TEST_F(MapCheckerTest, OccupancyOfAnotherSizeIsAWarning) {
  ASSERT_TRUE(io::write_png(folder_ / "occupancy.png", Image<std::uint8_t>(3, 4)));
  const MapProblem problem = only(check(map_yaml()), Severity::kWarning);
  EXPECT_EQ(problem.file.filename(), "occupancy.png");
}

TEST_F(MapCheckerTest, TooLargeAnAreaIsAskedForItsResolution) {
  write_text(folder_ / "map.yaml", replaced(map_yaml(), "resolution: 0.1", "resolution: 1.0"));
  ASSERT_TRUE(io::write_png(folder_ / "labels.png", RgbImage(1100, 1100, testing::color_of('.'))));
  const MapCheck result = check_map(folder_.path());
  EXPECT_TRUE(result.report.has_errors());
  EXPECT_THAT(to_string(result.report.problems.at(0)), HasSubstr("is the resolution right?"));
}

TEST_F(MapCheckerTest, NoRoomForACameraUnderTheCeiling) {
  CheckOptions options;
  options.eye_height_m = 9.0;
  const MapCheck result = check(map_yaml(), {"###", "#.#", "###"}, options);
  EXPECT_TRUE(result.report.has_errors());
  EXPECT_THAT(text_of(result), HasSubstr("a camera 9 m above the ground would be in or above"));
  EXPECT_THAT(text_of(result), HasSubstr("below the ceiling at"));
}

TEST_F(MapCheckerTest, NoFreeSpace) {
  check_loads_ = true;
  const MapCheck blocked = check(map_yaml(), {"   ", " T#", "###"});
  EXPECT_THAT(
      text_of(blocked),
      HasSubstr("labels.png: pixel (x 1, y 1): error: there is no free space: from here on "));
  EXPECT_THAT(text_of(blocked), HasSubstr("draw floor"));
  EXPECT_TRUE(blocked.report.has_errors());
  const MapCheck outside = check(map_yaml(), {"  ", "  "});
  EXPECT_THAT(text_of(outside),
              HasSubstr("labels.png: error: there is no free space: every pixel"));
  const std::string fine = replaced(map_yaml(), "resolution: 0.1", "resolution: 0.001");
  const MapCheck tiny = check(fine, {"###", "#.#", "###"});
  EXPECT_THAT(text_of(tiny), HasSubstr("labels.png: pixel (x 1, y 1): error: there is no free"));
  EXPECT_THAT(text_of(tiny), HasSubstr("is the resolution of 0.001 m per pixel right?"));
}

TEST_F(MapCheckerTest, WarnsOfDisconnectedFreeSpace) {
  const MapCheck result = check(map_yaml(),
                                {"##WW####DD##",  //
                                 "#.....#....#",
                                 "#.....#....#",
                                 "#..TT.#....#",
                                 "############"});
  const MapProblem problem = only(result, Severity::kWarning);
  const std::string text = to_string(problem);
  EXPECT_THAT(text, HasSubstr("13 of 27 free cells"));
  EXPECT_EQ(problem.file.filename(), "labels.png");
  ASSERT_TRUE(problem.pixel);
  EXPECT_LT(problem.pixel->column, 6) << "the left room is the smaller part";
}

}  // namespace
}  // namespace semview::map
