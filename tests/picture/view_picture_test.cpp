// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/view_picture.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace semview::picture {
namespace {

bool occurs(const RgbImage& image, const Rgb& colour) {
  return std::ranges::find(image.pixels(), colour) != image.pixels().end();
}

TEST(LabelPictureTest, EveryPixelIsAWholeBlockOfItsColour) {
  const ClassTable classes({"wall", "door"});
  const ClassPalette palette = ClassPalette::for_classes(classes);
  LabelImage labels(10, 120, 1);
  labels.at(4, 7) = 2;
  const RgbImage picture = draw_labels(labels, classes, palette, {.min_width_px = 240});
  // Two pixels a side, plus the door's swatch (16 × 16) in the legend.
  EXPECT_EQ(std::ranges::count(picture.pixels(), palette[2]), 2 * 2 + 16 * 16);
  EXPECT_GE(picture.columns(), 240);
}

TEST(LabelPictureTest, OnlyClassesThatOccurAreInTheLegend) {
  const ClassTable classes({"wall", "door"});
  const ClassPalette palette = ClassPalette::for_classes(classes);
  const RgbImage picture = draw_labels(LabelImage(9, 30, 1), classes, palette, {});
  EXPECT_TRUE(occurs(picture, palette[1]));
  EXPECT_FALSE(occurs(picture, palette[2]));
}

TEST(LabelPictureTest, ManyClassesMakeMoreLinesAndTitleAndAxesMakeRoom) {
  std::vector<std::string> names;
  for (int i = 0; i < 60; ++i) names.push_back("class number " + std::to_string(i));
  const ClassTable classes(names);
  const ClassPalette palette = ClassPalette::for_classes(classes);
  LabelImage labels(1, 60);
  for (int c = 0; c < 60; ++c) labels.at(0, c) = static_cast<ClassId>(c + 1);
  const RgbImage plain = draw_labels(labels, classes, palette, {});
  EXPECT_GT(plain.rows(), draw_labels(LabelImage(1, 60, 1), classes, palette, {}).rows() + 100);
  const RgbImage full = draw_labels(labels, classes, palette, {"a title", PanoramaCamera{60, 1}});
  EXPECT_GT(full.rows(), plain.rows());
  EXPECT_GT(full.columns(), plain.columns());
}

TEST(RangePictureTest, MissesAreGreyAndAllMissesAreNoFault) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  RangeImage ranges(4, 4, 2.0F);
  ranges.at(0, 0) = kInf;
  EXPECT_TRUE(occurs(draw_ranges(ranges, "range"), {206, 208, 212}));
  EXPECT_FALSE(draw_ranges(RangeImage(4, 4, kInf), "range").empty());
}

TEST(ViewPictureTest, NothingToDrawIsAnEmptyPicture) {
  EXPECT_TRUE(draw_labels({}, {}, ClassPalette::for_classes({})).empty());
  EXPECT_TRUE(draw_ranges({}, "range").empty());
}

}  // namespace
}  // namespace semview::picture
