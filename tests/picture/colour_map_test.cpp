// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/colour_map.hpp"

#include <gtest/gtest.h>

namespace semview::picture {
namespace {

TEST(ViridisTest, GoesFromVioletToYellowAndClamps) {
  EXPECT_EQ(viridis(0.0), (Rgb{68, 1, 84}));
  EXPECT_EQ(viridis(1.0), (Rgb{253, 231, 37}));
  EXPECT_EQ(viridis(-3.0), viridis(0.0));
  EXPECT_EQ(viridis(7.0), viridis(1.0));
}

TEST(ViridisTest, LightnessRisesThroughout) {
  const auto lightness = [](const Rgb& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; };
  for (int i = 0; i < 100; ++i) {
    EXPECT_LT(lightness(viridis(i / 100.0)), lightness(viridis((i + 1) / 100.0)) + 0.8);
  }
}

}  // namespace
}  // namespace semview::picture
