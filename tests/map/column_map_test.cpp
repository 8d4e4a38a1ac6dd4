// SPDX-License-Identifier: Apache-2.0
#include "semview/map/column_map.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "map/bundle.hpp"

namespace semview::map {
namespace {

using testing::columns;

TEST(ColumnMapTest, LowerLeftPixelBeginsAtTheOrigin) {
  const ColumnMap map = columns({"...", "#.."}, 0.5, {-1.0, 2.0, 0.0});
  EXPECT_EQ(map.pixel_at(-0.99, 2.01), (PixelIndex{1, 0}));
  EXPECT_EQ(map.pixel_at(-1.0, 2.0), (PixelIndex{1, 0}));
  EXPECT_EQ(map.pixel_at(0.49, 2.99), (PixelIndex{0, 2}));
  EXPECT_FALSE(map.pixel_at(-1.01, 2.1));
  EXPECT_FALSE(map.pixel_at(0.5, 2.1));
  EXPECT_FALSE(map.pixel_at(0.0, 3.0));
  ASSERT_NE(map.at(-0.9, 2.1), nullptr);
  EXPECT_EQ(map.at(-0.9, 2.1)->slabs.size(), 1U);
  EXPECT_EQ(map.at(5.0, 5.0), nullptr);
}

TEST(ColumnMapTest, AnEdgeBelongsToThePixelAboveAndRightOfIt) {
  const ColumnMap map = columns({"....", "....", "...."}, 0.1, {-0.3, -0.7, 0.0});
  for (int column = 0; column < 4; ++column) {
    for (int up = 0; up < 3; ++up) {
      // Decimal places of edges carry rounding errors of either sign.
      EXPECT_EQ(map.pixel_at(-0.3 + 0.1 * column, -0.7 + 0.1 * up), (PixelIndex{2 - up, column}));
    }
  }
}

TEST(ColumnMapTest, AQuarterTurnPutsTheImageLeftOfItsOrigin) {
  const ColumnMap map = columns({"..", "#."}, 1.0, {10.0, 20.0, kPi / 2.0});
  // The image's own right is +y, its up is -x.
  EXPECT_EQ(map.pixel_at(9.5, 20.5), (PixelIndex{1, 0}));
  EXPECT_EQ(map.pixel_at(9.5, 21.5), (PixelIndex{1, 1}));
  EXPECT_EQ(map.pixel_at(8.5, 20.5), (PixelIndex{0, 0}));
  const Bounds bounds = map.bounds();
  EXPECT_NEAR(bounds.min_x_m, 8.0, 1e-12);
  EXPECT_NEAR(bounds.max_x_m, 10.0, 1e-12);
  EXPECT_NEAR(bounds.min_y_m, 20.0, 1e-12);
  EXPECT_NEAR(bounds.max_y_m, 22.0, 1e-12);
}

TEST(ColumnMapTest, PixelOfAPixelsCentreIsThatPixel) {
  EXPECT_TRUE(rc::check([] {
    const double yaw = *rc::gen::inRange(-314, 315) / 100.0;
    const double x = *rc::gen::inRange(-100000, 100000) / 100.0;
    const double resolution = *rc::gen::inRange(1, 1000) / 1000.0;
    const ColumnMap map =
        columns(std::vector<std::string>(7, std::string(9, '.')), resolution, {x, -x / 3.0, yaw});
    const PixelIndex pixel{*rc::gen::inRange(0, 7), *rc::gen::inRange(0, 9)};
    const Eigen::Vector2d center = map.pixel_center(pixel);
    RC_ASSERT(map.pixel_at(center.x(), center.y()) == pixel);
    const Eigen::Vector2d plan = map.plan_from_map(center.x(), center.y());
    const Eigen::Vector2d back = map.map_from_plan(plan.x(), plan.y());
    RC_ASSERT((back - center).norm() < 1e-9);
  }));
}

}  // namespace
}  // namespace semview::map
