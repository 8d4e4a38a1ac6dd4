// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/sheet_picture.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace semview::picture {
namespace {

constexpr Rgb kRed{200, 10, 10};
constexpr Rgb kGreen{10, 200, 10};
constexpr Rgb kBlue{10, 10, 200};

SheetPicture two_panels() {
  SheetPicture picture;
  picture.panels = {{"left", RgbImage(100, 300, kRed)}, {"right", RgbImage(60, 200, kGreen)}};
  picture.marks = {{kBlue, "a robot"}};
  return picture;
}

std::ptrdiff_t pixels_of(const RgbImage& image, Rgb colour) {
  return std::ranges::count(image.pixels(), colour);
}

TEST(SheetPictureTest, PanelsKeepTheirPixelsAndMarksAreExplained) {
  const RgbImage sheet = draw_sheet(two_panels());
  EXPECT_EQ(pixels_of(sheet, kRed), 100 * 300);
  EXPECT_EQ(pixels_of(sheet, kGreen), 60 * 200);
  EXPECT_GT(pixels_of(sheet, kBlue), 0) << "the legend shows the colour";
}

TEST(SheetPictureTest, TitleAndScaleAreThereWhereTheyAreAskedFor) {
  SheetPicture picture = two_panels();
  const RgbImage plain = draw_sheet(picture);
  picture.pixels_per_m = 25.0;
  const RgbImage scaled = draw_sheet(picture);
  EXPECT_EQ(plain.rows(), scaled.rows());
  EXPECT_FALSE(std::ranges::equal(plain.pixels(), scaled.pixels()));
  picture.title = "A building";
  EXPECT_GT(draw_sheet(picture).rows(), plain.rows());
}

}  // namespace
}  // namespace semview::picture
