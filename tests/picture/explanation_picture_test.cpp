// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/explanation_picture.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "semview/picture/colour_map.hpp"

namespace semview::picture {
namespace {

std::ptrdiff_t count(const RgbImage& image, const Rgb& colour) {
  return std::ranges::count(image.pixels(), colour);
}

TEST(ExplanationPictureTest, RaisesAreBlueLossesRedAndTheScaleIsSymmetric) {
  EXPECT_EQ(diverging(0.0), (Rgb{255, 255, 255}));
  EXPECT_EQ(diverging(7.0), diverging(1.0));
  EXPECT_GT(diverging(1.0).b, diverging(1.0).r);
  EXPECT_GT(diverging(-1.0).r, diverging(-1.0).b);

  ExplanationPicture picture;
  picture.camera.columns = 120;
  picture.camera.rows = 8;
  picture.observed_classes = ClassTable({"door", "wall"});
  picture.map_classes = ClassTable({"wall", "door"});
  picture.observed = LabelImage(8, 120, 2);
  picture.observed.at(0, 0) = kUnknown;
  picture.view = LabelImage(8, 120, 1);
  picture.contributions = Image<double>(8, 120, 0.5);
  picture.contributions.at(0, 0) = 0.0;
  picture.contributions.at(3, 3) = -1.0;
  picture.title = "a title";
  picture.min_width_px = 240;
  const RgbImage image = draw_explanation(picture);
  // Two pixels a side, and a swatch (16 x 16) in the legend.
  EXPECT_EQ(count(image, diverging(-1.0)), 2 * 2 + 16 * 16);
  EXPECT_EQ(count(image, diverging(0.5)), (8 * 120 - 2) * 4 + 16 * 16);
  EXPECT_EQ(count(image, diverging(1.0)), 16 * 16) << "only in the legend";
  const Rgb wall = ClassPalette::for_classes(picture.map_classes)[1];
  EXPECT_EQ(count(image, wall), (2 * 8 * 120 - 1) * 4 + 2 * 16 * 16)
      << "one colour for a class in both tables";
}

}  // namespace
}  // namespace semview::picture
