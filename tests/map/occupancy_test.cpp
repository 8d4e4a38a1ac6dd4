// SPDX-License-Identifier: Apache-2.0
#include "semview/map/occupancy.hpp"

#include <gtest/gtest.h>

#include "map/bundle.hpp"

namespace semview::map {
namespace {

using testing::columns;

TEST(OccupancyTest, GreysAreThoseOfMapServer) {
  const Image<std::uint8_t> image = occupancy_image(columns({".#Dt "}));
  EXPECT_EQ(image.at(0, 0), 254);
  EXPECT_EQ(image.at(0, 1), 0);
  EXPECT_EQ(image.at(0, 2), 254) << "a door is passable";
  EXPECT_EQ(image.at(0, 3), 0) << "a table top is in a robot's way";
  EXPECT_EQ(image.at(0, 4), 205);
}

TEST(OccupancyTest, ALowRobotPassesUnderTheTable) {
  EXPECT_EQ(occupancy_image(columns({"t"}), 0.5).at(0, 0), 254);
}

TEST(PlanImageTest, PixelsHaveTheirClassesColoursAndOutsideIsWhite) {
  testing::TempFolder folder;
  testing::write_bundle(folder.path(), testing::room());
  const Result<SemanticMap> map = load_map(folder.path());
  ASSERT_TRUE(map);
  const RgbImage image = plan_image(*map, *map->columns());
  const RgbImage drawn = testing::drawing(testing::room());
  for (int row = 0; row < image.rows(); ++row) {
    for (int column = 0; column < image.columns(); ++column) {
      const Rgb expected = drawn.at(row, column);
      ASSERT_EQ(image.at(row, column), expected == Rgb{} ? (Rgb{255, 255, 255}) : expected);
    }
  }
}

}  // namespace
}  // namespace semview::map
