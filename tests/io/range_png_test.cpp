// SPDX-License-Identifier: Apache-2.0
#include "semview/io/range_png.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semview::io {
namespace {

TEST(RangePngTest, RoundsToMillimetresAndKeepsZeroForNothing) {
  RangeImage ranges_m(1, 7);
  const float values[] = {
      std::numeric_limits<float>::infinity(), 0.0F, 0.0004F, 1.2344F, 1.2346F, 65.5349F, 80.0F};
  for (int c = 0; c < 7; ++c) ranges_m.at(0, c) = values[c];
  const Image<std::uint16_t> result = millimetres(ranges_m);
  EXPECT_THAT(result.pixels(), testing::ElementsAre(0, 1, 1, 1234, 1235, 65535, 65535));
}

}  // namespace
}  // namespace semview::io
