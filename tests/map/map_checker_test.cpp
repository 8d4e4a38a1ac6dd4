// SPDX-License-Identifier: Apache-2.0
/// Each rule of `semview map check` has a small bundle that breaks it and nothing else.
#include "semview/map/map_checker.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include "map/bundle.hpp"
#include "semview/io/png.hpp"

namespace semview::map {
namespace {

using testing::drawing;
using ::testing::HasSubstr;
using testing::map_yaml;
using testing::replaced;
using testing::room;
using testing::TempFolder;
using testing::write_bundle;
using testing::write_text;

class MapCheckerTest : public ::testing::Test {
 protected:
  MapCheck check(const std::string& yaml,
                 const std::vector<std::string>& rows = room(),
                 const CheckOptions& options = {}) {
    write_bundle(folder_.path(), rows, yaml);
    return check_map(folder_.path(), options);
  }

  static std::string text_of(const MapCheck& check) {
    std::string all;
    for (const MapProblem& problem : check.report.problems) all += to_string(problem) + "\n";
    return all;
  }

  /// Expects exactly one problem and returns it.
  MapProblem only(const MapCheck& check, Severity severity) {
    const std::string all = text_of(check);
    EXPECT_EQ(check.report.problems.size(), 1U) << all;
    if (check.report.problems.empty()) return {};
    const MapProblem& problem = check.report.problems.front();
    EXPECT_EQ(problem.severity, severity) << all;
    EXPECT_EQ(check.map.has_value(), severity == Severity::kWarning || check_loads_);
    return problem;
  }

  /// One error in a line of map.yaml, with all of `words` in what is printed.
  void expect_error(const std::string& yaml, int line, const std::vector<std::string>& words) {
    const MapProblem problem = only(check(yaml), Severity::kError);
    expect_words(problem, line, words);
  }
  void expect_warning(const std::string& yaml, int line, const std::vector<std::string>& words) {
    const MapProblem problem = only(check(yaml), Severity::kWarning);
    expect_words(problem, line, words);
  }
  void expect_words(const MapProblem& problem, int line, const std::vector<std::string>& words) {
    EXPECT_EQ(problem.file.filename(), "map.yaml");
    EXPECT_EQ(problem.line, line);
    const std::string text = to_string(problem);
    EXPECT_THAT(text, HasSubstr(fmt::format("map.yaml:{}: ", line)));
    for (const std::string& word : words) EXPECT_THAT(text, HasSubstr(word));
  }

  TempFolder folder_;
  bool check_loads_ = false;
};

TEST_F(MapCheckerTest, AGoodMapHasNoProblem) {
  const MapCheck result = check(map_yaml());
  EXPECT_TRUE(result.report.problems.empty());
  ASSERT_TRUE(result.map);
  EXPECT_EQ(result.map->id, "test_room");
}

// Colours

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

TEST_F(MapCheckerTest, DuplicateColour) {
  std::vector<std::string> rows = room();
  for (std::string& row : rows) std::replace(row.begin(), row.end(), 'T', '.');
  const MapCheck result = check(replaced(map_yaml(), "[255, 6, 82]", "[8, 255, 51]"), rows);
  EXPECT_EQ(result.report.count(Severity::kError), 1U);
  expect_words(result.report.problems.at(0),
               19,
               {"class table has the colour of class door", "[8, 255, 51]"});
}

TEST_F(MapCheckerTest, ColourOfOutside) {
  check_loads_ = false;
  const MapCheck result =
      check(replaced(map_yaml(), "outside: [0, 0, 0]", "outside: [120, 120, 120]"));
  EXPECT_THAT(text_of(result),
              HasSubstr("map.yaml:16: error: class wall has the colour of outside"));
}

TEST_F(MapCheckerTest, ColourThatIsNone) {
  expect_error(
      replaced(map_yaml(), "[255, 6, 82]", "[256, 6, 82]"), 19, {"error: colour value 256"});
}

TEST_F(MapCheckerTest, EveryBadValueOfAColourIsNamed) {
  expect_error(replaced(map_yaml(), "[255, 6, 82]", "[256, 6, -1]"),
               19,
               {"colour values 256, -1 are not whole numbers in 0..255"});
  expect_error(replaced(map_yaml(), "[255, 6, 82]", "[255, 6, 82, 1]"),
               19,
               {"a list of 4 is not a list of 3 numbers", "for example [120, 120, 120]"});
}

// Names and ids

TEST_F(MapCheckerTest, ABlankNameIsNone) {
  for (const std::string blank : {"''", "'  '"}) {
    expect_error(replaced(map_yaml(), "{name: table", "{name: " + blank),
                 19,
                 {"the name of a class is blank", "name: wall"});
  }
}

TEST_F(MapCheckerTest, DuplicateName) {
  const MapCheck result = check(replaced(map_yaml(), "{name: ceiling}", "{name: floor}"));
  EXPECT_THAT(text_of(result),
              HasSubstr("map.yaml:15: error: class floor is listed twice (first in line 14)"));
}

TEST_F(MapCheckerTest, ReservedAndUnusableNames) {
  expect_error(replaced(map_yaml(), "name: table", "name: none"), 19, {"none is reserved"});
  expect_error(replaced(map_yaml(), "name: table", "name: 'a,b'"), 19, {"a,b is not usable"});
}

TEST_F(MapCheckerTest, IdWithOtherCharacters) {
  expect_error(replaced(map_yaml(), "test_room", "Test room"), 7, {"id Test room", "a-z"});
}

TEST_F(MapCheckerTest, TheFoldersNameIsTheDefaultIdAndMustBeOne) {
  const std::string yaml = replaced(map_yaml(), "  id: test_room\n", "");
  write_bundle(folder_ / "my_flat", room(), yaml);
  const MapCheck good = check_map(folder_ / "my_flat");
  ASSERT_TRUE(good.map);
  EXPECT_EQ(good.map->id, "my_flat");
  write_bundle(folder_ / "My Flat", room(), yaml);
  EXPECT_THAT(to_string(only(check_map(folder_ / "My Flat"), Severity::kError)),
              HasSubstr("the folder's name"));
}

TEST_F(MapCheckerTest, TwoMapsWithOneId) {
  write_bundle(folder_ / "a", room());
  write_bundle(folder_ / "b", room());
  const std::vector<std::filesystem::path> paths{folder_ / "a", folder_ / "b"};
  std::vector<MapCheck> checks{check_map(paths[0]), check_map(paths[1])};
  check_unique_ids(paths, checks);
  EXPECT_FALSE(checks[0].report.has_errors());
  check_loads_ = true;
  const std::string text = to_string(only(checks[1], Severity::kError));
  EXPECT_THAT(text, HasSubstr("id test_room is also that of"));
  EXPECT_THAT(text, HasSubstr((folder_ / "a" / "map.yaml").string()));
}

// Heights

TEST_F(MapCheckerTest, HeightsOutOfOrder) {
  expect_error(replaced(map_yaml(), "min_height: 0.7,", "min_height: 2.4,"),
               19,
               {"min_height 2.4 of class table is above its max_height 0.75"});
}

TEST_F(MapCheckerTest, NoThicknessIsPaintAtTheGroundOnly) {
  expect_error(
      replaced(map_yaml(), "min_height: 0.7,", "min_height: 0.75,"), 19, {"no thickness", "paint"});
}

TEST_F(MapCheckerTest, HeightMissingOrNoNumber) {
  expect_error(replaced(map_yaml(), "min_height: 0.7, ", ""), 19, {"lacks min_height"});
  expect_error(replaced(map_yaml(), "min_height: 0.7,", "min_height: high,"), 19, {"high"});
}

TEST_F(MapCheckerTest, HeightOutOfLimits) {
  const MapCheck result = check(replaced(map_yaml(), "max_height: 0.75", "max_height: 1e9"));
  EXPECT_THAT(to_string(result.report.problems.at(0)), HasSubstr("out of limits"));
}

TEST_F(MapCheckerTest, CeilingBelowGround) {
  const MapCheck result = check(replaced(map_yaml(), "height: 2.6}", "height: 0.0}"));
  EXPECT_THAT(to_string(result.report.problems.at(0)),
              HasSubstr("map.yaml:10: error: ceiling height 0 is not above the ground's height 0"));
}

TEST_F(MapCheckerTest, WarnsOfHeightsCutAtCeilingAndGround) {
  expect_warning(replaced(map_yaml(), "max_height: 0.75", "max_height: 2.7"),
                 19,
                 {"warning", "class table is cut at the ceiling", "2.7 is above 2.6"});
  expect_warning(replaced(map_yaml(), "min_height: 0.7,", "min_height: -0.2,"),
                 19,
                 {"warning", "cut at the ground"});
}

// References

TEST_F(MapCheckerTest, UnknownClassInAboveBelowCeilingAndGround) {
  expect_error(
      replaced(map_yaml(), "2.1, above: wall}", "2.1, above: wal}"),
      17,
      {"above of class door names class wal", "did you mean wall? listed: ceiling, floor, wall"});
  expect_error(replaced(map_yaml(), "below: wall", "below: brick"),
               18,
               {"below of class window names class brick"});
  const MapCheck ceiling = check(replaced(map_yaml(), "class: ceiling", "class: roof"));
  EXPECT_EQ(ceiling.report.count(Severity::kError), 1U);
  expect_words(ceiling.report.problems.at(0), 10, {"ceiling names class roof"});
  expect_error(
      replaced(map_yaml(), "class: floor", "class: earth"), 11, {"ground names class earth"});
}

TEST_F(MapCheckerTest, ReferenceToItself) {
  expect_error(
      replaced(map_yaml(), "max_height: 2.1, above: wall}", "max_height: 2.1, above: door}"),
      17,
      {"above of class door names the class itself", "wall for example"});
}

TEST_F(MapCheckerTest, ReferenceToAClassWithoutHeights) {
  expect_error(replaced(map_yaml(), "2.1, above: wall}", "2.1, above: ceiling}"),
               17,
               {"ceiling, which has no heights"});
}

TEST_F(MapCheckerTest, WarnsOfUnusedClasses) {
  std::vector<std::string> rows = room();
  for (std::string& row : rows) std::replace(row.begin(), row.end(), 'T', '.');
  const MapProblem problem = only(check(map_yaml(), rows), Severity::kWarning);
  expect_words(problem, 19, {"class table is not used"});
}

// The file

TEST_F(MapCheckerTest, UnknownKeysAreErrorsInOurBlockOnly) {
  expect_error(replaced(map_yaml(), "  name: Test room", "  nmae: Test room"),
               8,
               {"unknown key nmae", "did you mean name? known here:"});
  expect_error(replaced(map_yaml(), "movable", "moveable"),
               19,
               {"unknown key moveable", "did you mean movable?"});
  EXPECT_TRUE(check("mode: trinary\n" + map_yaml()).report.problems.empty());
}

TEST_F(MapCheckerTest, MovableIsAProbability) {
  expect_error(replaced(map_yaml(), "movable: 0.5", "movable: 5"), 19, {"movable 5"});
}

TEST_F(MapCheckerTest, NewerFormatIsUnimplemented) {
  const MapProblem problem =
      only(check(replaced(map_yaml(), "format: 1", "format: 2")), Severity::kError);
  expect_words(problem, 6, {"format 2 is not known"});
  EXPECT_EQ(problem.code, ErrorCode::kUnimplemented);
}

TEST_F(MapCheckerTest, AWrongFormatHidesNothingElse) {
  for (const std::string format : {"2", "one", "0"}) {
    std::string yaml = replaced(map_yaml(), "format: 1", "format: " + format);
    yaml = replaced(yaml, "movable: 0.5", "movable: 5");
    std::vector<std::string> rows = room();
    rows[6][4] = '?';
    const MapCheck result = check(yaml, rows);
    EXPECT_THAT(text_of(result), HasSubstr("map.yaml:6: error: format"));
    EXPECT_THAT(text_of(result), HasSubstr("map.yaml:19: error: movable 5"));
    EXPECT_THAT(text_of(result), HasSubstr("labels.png: pixel (x 4, y 6): error: colour"));
    EXPECT_EQ(result.report.problems.size(), 3U) << text_of(result);
  }
}

TEST_F(MapCheckerTest, WhatOnlyRosToolsReadIsCheckedForThem) {
  expect_error(
      replaced(map_yaml(), "negate: 0", "negate: 5"), 4, {"negate 5", "0, 1, false, true"});
  expect_error(replaced(map_yaml(), "negate: 0", "occupied_thresh: 7"),
               4,
               {"occupied_thresh 7 is out of limits", "within 0 to 1"});
  expect_error(replaced(map_yaml(), "negate: 0", "free_thresh: low"), 4, {"free_thresh: 0.25"});
  expect_error(replaced(map_yaml(), "negate: 0", "mode: binary"), 4, {"trinary, scale, raw"});
}

TEST_F(MapCheckerTest, ANumberThatIsNoneIsAnsweredWithAnExample) {
  for (const std::string bad : {"five", ".nan"}) {
    const MapCheck result = check(replaced(map_yaml(), "resolution: 0.1", "resolution: " + bad));
    EXPECT_THAT(text_of(result),
                HasSubstr("'" + bad +
                          "' is not a number; write for example "
                          "`resolution: 0.02`"));
  }
  expect_error(replaced(map_yaml(), "[-1.0, 2.0, 0.0]", "[-1.0, 2.0]"),
               3,
               {"a list of 2 is not a list of 3 numbers", "origin: [0.0, 0.0, 0.0]", "radians"});
}

TEST_F(MapCheckerTest, APlainRosMapIsPointedToTheImporter) {
  write_text(folder_ / "map.yaml", "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n");
  EXPECT_THAT(to_string(only(check_map(folder_.path()), Severity::kError)),
              HasSubstr("map import ros"));
}

TEST_F(MapCheckerTest, NotYaml) {
  write_text(folder_ / "map.yaml", "a: [1, 2\nb: }\n");
  EXPECT_TRUE(check_map(folder_.path()).report.has_errors());
}

TEST_F(MapCheckerTest, MissingKeysAreNamedWithAnExample) {
  expect_error(replaced(map_yaml(), "  ground: {class: floor, height: 0.0}\n", ""),
               6,
               {"ground is missing", "ground: {class: floor, height: 0.0}"});
  expect_error(replaced(map_yaml(), "  labels: labels.png\n", ""), 6, {"neither labels nor mesh"});
  const MapCheck result = check(replaced(map_yaml(), "resolution: 0.1\n", ""));
  EXPECT_THAT(to_string(result.report.problems.at(0)), HasSubstr("resolution is missing"));
}

TEST_F(MapCheckerTest, ResolutionOutOfLimits) {
  for (const std::string bad : {"0.0001", "2.0", "-0.1", "0"}) {
    const MapCheck result = check(replaced(map_yaml(), "resolution: 0.1", "resolution: " + bad));
    ASSERT_TRUE(result.report.has_errors()) << bad;
    EXPECT_THAT(to_string(result.report.problems[0]), HasSubstr("map.yaml:2: error: resolution"));
  }
  EXPECT_TRUE(
      check(replaced(map_yaml(), "resolution: 0.1", "resolution: .nan")).report.has_errors());
}

TEST_F(MapCheckerTest, OriginOutOfLimits) {
  expect_error(replaced(map_yaml(), "[-1.0, 2.0, 0.0]", "[-1.0, 2.0, 90.0]"), 3, {"radians"});
  expect_error(replaced(map_yaml(), "[-1.0, 2.0, 0.0]", "[1e8, 2.0, 0.0]"), 3, {"origin"});
  const MapCheck two = check(replaced(map_yaml(), "[-1.0, 2.0, 0.0]", "[-1.0, 2.0]"));
  EXPECT_THAT(to_string(two.report.problems.at(0)), HasSubstr("map.yaml:3: error: "));
}

TEST_F(MapCheckerTest, ClassFileIsReadAndNamedInItsErrors) {
  std::string yaml = map_yaml();
  const std::size_t list = yaml.find("    - {name: ceiling}");
  write_text(folder_ / "classes.yaml", yaml.substr(list));
  const std::string head = replaced(yaml.substr(0, list), "classes:", "classes: classes.yaml");
  EXPECT_TRUE(check(head).report.problems.empty());

  write_text(folder_ / "classes.yaml",
             replaced(yaml.substr(list), "min_height: 0.7,", "min_height: 2.4,"));
  const MapProblem problem = only(check(head), Severity::kError);
  EXPECT_EQ(problem.file.filename(), "classes.yaml");
  EXPECT_EQ(problem.line, 6);

  std::filesystem::remove(folder_ / "classes.yaml");
  const MapCheck missing = check(head);
  EXPECT_EQ(missing.report.problems.at(0).file.filename(), "classes.yaml");
}

TEST_F(MapCheckerTest, TooManyClasses) {
  std::string yaml = map_yaml();
  for (int i = 0; i < 260; ++i) yaml += fmt::format("    - {{name: spare{}}}\n", i);
  const MapCheck result = check(yaml);
  EXPECT_THAT(to_string(result.report.problems.at(0)), HasSubstr("266 classes are too many"));
}

TEST_F(MapCheckerTest, OneSlipIsOneError) {
  expect_error(replaced(map_yaml(), "  format: 1", "  fromat: 1"), 6, {"did you mean format?"});
  expect_error(
      replaced(map_yaml(), "labels: labels", "label: labels"), 9, {"did you mean labels?"});
  expect_error(replaced(map_yaml(), "ground: {", "gruond: {"), 11, {"did you mean ground?"});
  expect_error(replaced(map_yaml(), "  outside:", "  outsied:"), 12, {"did you mean outside?"});
  expect_error(replaced(map_yaml(), "  classes:", "  clases:"), 13, {"did you mean classes?"});
  expect_error(replaced(map_yaml(), "{name: wall", "{nmae: wall"), 16, {"did you mean name?"});
  expect_error(replaced(map_yaml(), "floor, color", "floor, colour"), 15, {"did you mean color?"});
  expect_error(replaced(map_yaml(), "0.7, max_height", "0.7, max_hieght"), 19, {"max_height?"});
  expect_error(replaced(map_yaml(), "ceiling, height: 2.6", "ceiling, height: high"), 10, {"high"});
  expect_error(replaced(map_yaml(), "  labels: labels.png", "  labels: [a]"), 9, {"labels"});
}

TEST_F(MapCheckerTest, AFarWordIsNotSuggested) {
  const MapCheck result = check(replaced(map_yaml(), "  name: Test room", "  author: somebody"));
  EXPECT_THAT(text_of(result), HasSubstr("unknown key author; known here:"));
}

TEST_F(MapCheckerTest, AMapIsMadeOfFilesInItsFolder) {
  for (const std::string bad : {"../../..", "../labels.png", "/etc/passwd", "a/../../labels.png"}) {
    expect_error(replaced(map_yaml(), "labels: labels.png", "labels: " + bad),
                 9,
                 {"labels " + bad + " is not in the map's folder", "put the file beside map.yaml"});
  }
  expect_error(replaced(map_yaml(), "labels: labels.png", "mesh: ../house.glb"),
               9,
               {"mesh ../house.glb is not in"});
  EXPECT_TRUE(check(replaced(map_yaml(), "labels: labels.png", "labels: ./labels.png"))
                  .report.problems.empty());
}

TEST_F(MapCheckerTest, ProblemsAreListedByFileAndPlace) {
  std::vector<std::string> rows = room();
  rows[6][4] = '?';
  std::string yaml = replaced(map_yaml(), "movable: 0.5", "movable: 5");
  yaml = replaced(yaml, "test_room", "Test room");
  const MapCheck result = check(replaced(yaml, "above: wall}", "above: brick}"), rows);
  std::vector<std::string> places;
  for (const MapProblem& problem : result.report.problems) {
    places.push_back(problem.file.filename().string() + ":" + std::to_string(problem.line));
  }
  EXPECT_THAT(places,
              ::testing::ElementsAre("labels.png:0", "map.yaml:7", "map.yaml:17", "map.yaml:19"));
}

// Images

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

// Free space

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

TEST_F(MapCheckerTest, NoSuchPath) {
  const MapProblem problem = only(check_map(folder_ / "nowhere"), Severity::kError);
  EXPECT_EQ(problem.code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace semview::map
