// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/class_palette.hpp"

#include <cstdlib>

#include <gtest/gtest.h>

namespace semview::picture {
namespace {

int difference(const Rgb& a, const Rgb& b) {
  return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
}

TEST(ClassPaletteTest, TheClassesOfAPlanAreToldApart) {
  const ClassTable classes({"wall",
                            "floor",
                            "ceiling",
                            "door",
                            "window",
                            "table",
                            "chair",
                            "sofa",
                            "cabinet",
                            "stairs",
                            "railing",
                            "countertop",
                            "desk",
                            "crate",
                            "robot",
                            "aquarium"});
  const ClassPalette palette = ClassPalette::for_classes(classes);
  for (int a = 0; a <= classes.size(); ++a) {
    for (int b = a + 1; b <= classes.size(); ++b) {
      EXPECT_GT(difference(palette[static_cast<ClassId>(a)], palette[static_cast<ClassId>(b)]), 24)
          << classes.name(static_cast<ClassId>(a)) << ", " << classes.name(static_cast<ClassId>(b));
    }
  }
}

TEST(ClassPaletteTest, AKnownNameHasItsColourWhereverItStands) {
  const ClassPalette first = ClassPalette::for_classes(ClassTable({"wall", "door"}));
  const ClassPalette second = ClassPalette::for_classes(ClassTable({"crate", "door", "wall"}));
  EXPECT_EQ(first[1], second[3]);
  EXPECT_EQ(first[2], second[2]);
}

TEST(ClassPaletteTest, AColourMayBeSet) {
  ClassPalette palette = ClassPalette::for_classes(ClassTable({"wall"}));
  palette.set(1, {1, 2, 3});
  EXPECT_EQ(palette[1], (Rgb{1, 2, 3}));
}

}  // namespace
}  // namespace semview::picture
