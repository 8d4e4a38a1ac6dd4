// SPDX-License-Identifier: Apache-2.0
// What is wrong with the heights of classes, ground and ceiling.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/map_checker_fixture.hpp"

namespace semview::map {
namespace {

using ::testing::HasSubstr;
using testing::map_yaml;
using testing::replaced;

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

}  // namespace
}  // namespace semview::map
