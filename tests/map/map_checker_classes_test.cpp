// SPDX-License-Identifier: Apache-2.0
// What is wrong with the list of classes: colours, names, references.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/map_checker_fixture.hpp"

namespace semview::map {
namespace {

using ::testing::HasSubstr;
using testing::map_yaml;
using testing::replaced;
using testing::room;
using testing::write_text;

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

TEST_F(MapCheckerTest, MovableIsAProbability) {
  expect_error(replaced(map_yaml(), "movable: 0.5", "movable: 5"), 19, {"movable 5"});
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

}  // namespace
}  // namespace semview::map
