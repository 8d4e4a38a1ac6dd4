// SPDX-License-Identifier: Apache-2.0
// What is wrong with map.yaml as a file, its ids and what lies beside it.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/map_checker_fixture.hpp"

namespace semview::map {
namespace {

using ::testing::HasSubstr;
using testing::map_yaml;
using testing::replaced;
using testing::room;
using testing::write_bundle;
using testing::write_text;

TEST_F(MapCheckerTest, AGoodMapHasNoProblem) {
  const MapCheck result = check(map_yaml());
  EXPECT_TRUE(result.report.problems.empty());
  ASSERT_TRUE(result.map);
  EXPECT_EQ(result.map->id, "test_room");
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

TEST_F(MapCheckerTest, UnknownKeysAreErrorsInOurBlockOnly) {
  expect_error(replaced(map_yaml(), "  name: Test room", "  nmae: Test room"),
               8,
               {"unknown key nmae", "did you mean name? known here:"});
  expect_error(replaced(map_yaml(), "movable", "moveable"),
               19,
               {"unknown key moveable", "did you mean movable?"});
  EXPECT_TRUE(check("mode: trinary\n" + map_yaml()).report.problems.empty());
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

TEST_F(MapCheckerTest, NoSuchPath) {
  const MapProblem problem = only(check_map(folder_ / "nowhere"), Severity::kError);
  EXPECT_EQ(problem.code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace semview::map
