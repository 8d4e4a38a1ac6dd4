// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "semview/core/random.hpp"
#include "semview/view/view_codec.hpp"
#include "support/random_view.hpp"

namespace semview {
namespace {

TEST(ViewCodecTest, DecodesWhatItEncoded) {
  EXPECT_TRUE(rc::check([] {
    const int columns = *rc::gen::inRange(1, 200);
    const int rows = *rc::gen::inRange(1, 60);
    const ColumnView view =
        testing::random_view(*rc::gen::arbitrary<std::uint64_t>(), columns, rows, 254);
    const auto decoded = decode_view(kViewCodec, encode_view(view), {columns, rows, false});
    RC_ASSERT(decoded.has_value());
    RC_ASSERT(*decoded == view);
  }));
}

// As rooms look: edges that move at all speeds, now and then a column of other classes.
ColumnView rhythmic_view(std::uint64_t seed, int columns, int rows) {
  Rng rng(seed, "rhythm");
  LabelImage labels(rows, columns);
  double upper = 0.3, lower = 0.7, speed = 0.0;
  ClassId wall = 1;
  for (int c = 0; c < columns; ++c) {
    if (rng.uniform() < 0.05) speed = rng.uniform(-1.0, 1.0) * rng.uniform() * rng.uniform();
    if (rng.uniform() < 0.03) wall = static_cast<ClassId>(rng.below(20));
    if (rng.uniform() < 0.02) upper = rng.uniform();
    upper = std::clamp(upper + speed, 0.0, 1.0);
    lower = std::clamp(lower - speed / 3.0, 0.0, 1.0);
    for (int r = 0; r < rows; ++r) {
      const double height = (r + 0.5) / rows;
      labels.at(r, c) = height < upper ? 30 : height < lower ? wall : 31;
    }
  }
  return ColumnView::from_labels(labels);
}

TEST(ViewCodecTest, DecodesEdgesThatMoveSteadily) {
  EXPECT_TRUE(rc::check([] {
    const int columns = *rc::gen::inRange(1, 1200);
    const int rows = *rc::gen::inRange(1, 1024);
    const ColumnView view = rhythmic_view(*rc::gen::arbitrary<std::uint64_t>(), columns, rows);
    const auto decoded = decode_view(kViewCodec, encode_view(view), {columns, rows, false});
    RC_ASSERT(decoded.has_value());
    RC_ASSERT(*decoded == view);
  }));
}

// More edges than a word has bits, each moving in its own columns.
TEST(ViewCodecTest, DecodesMoreEdgesThanAWordHasBits) {
  LabelImage labels(900, 240);
  for (int c = 0; c < 240; ++c) {
    for (int r = 0; r < 900; ++r) {
      const int run = std::clamp((r + (c % (3 + (r / 6) % 5) == 0 ? 1 : 0)) / 6, 0, 149);
      labels.at(r, c) = static_cast<ClassId>(1 + run % 2);
    }
  }
  const ColumnView view = ColumnView::from_labels(labels);
  ASSERT_GT(view.column(0).size(), 128U);
  const auto decoded = decode_view(kViewCodec, encode_view(view), {240, 900, false});
  ASSERT_TRUE(decoded.has_value());
  EXPECT_EQ(*decoded, view);
}

TEST(ViewCodecTest, CodesTheLargestPanorama) {
  const ColumnView view = testing::random_view(1, 3600, 1024);
  const auto decoded = decode_view(kViewCodec, encode_view(view), {3600, 1024, false});
  ASSERT_TRUE(decoded.has_value());
  EXPECT_EQ(*decoded, view);
}

TEST(ViewCodecTest, DecodesPlanesBitByBit) {
  EXPECT_TRUE(rc::check([] {
    const int columns = *rc::gen::inRange(1, 200);
    const int rows = *rc::gen::inRange(1, 60);
    const ColumnView view =
        testing::random_view_with_ranges(*rc::gen::arbitrary<std::uint64_t>(), columns, rows);
    RC_ASSERT(view.has_ranges());
    const auto decoded = decode_view(kViewCodec, encode_view(view), {columns, rows, true});
    RC_ASSERT(decoded.has_value());
    RC_ASSERT(*decoded == view);
  }));
}

TEST(ViewCodecTest, DecodesPlanesOfAnySize) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  constexpr float kSmallest = std::numeric_limits<float>::denorm_min();
  std::vector<std::uint32_t> first_run = {0};
  std::vector<semview::Run> runs;  // in a test, Run is another
  std::vector<RunPlane> planes;
  for (const float a : {1.0F, kLargest, -kLargest, kSmallest, -kSmallest, 0.0F, -1.0F, kLargest}) {
    runs.push_back({1, 1});
    planes.push_back({a, a == 0.0F ? kSmallest : -a});
    first_run.push_back(static_cast<std::uint32_t>(runs.size()));
  }
  const auto view = ColumnView::from_runs(1, first_run, runs, planes);
  ASSERT_TRUE(view.has_value());
  const auto decoded = decode_view(kViewCodec, encode_view(*view), {8, 1, true});
  ASSERT_TRUE(decoded.has_value());
  EXPECT_EQ(*decoded, *view);
}

TEST(ViewCodecTest, RangesAreAnotherShape) {
  const std::vector<std::byte> with = encode_view(testing::random_view_with_ranges(2, 120, 20));
  EXPECT_FALSE(decode_view(kViewCodec, with, {120, 20, false}).has_value());
  EXPECT_EQ(claimed_shape(kViewCodec, with), (ViewShape{120, 20, true}));
  const std::vector<std::byte> without = encode_view(testing::random_view(2, 120, 20));
  EXPECT_FALSE(decode_view(kViewCodec, without, {120, 20, true}).has_value());
  EXPECT_EQ(claimed_shape(kViewCodec, without), (ViewShape{120, 20, false}));
  EXPECT_EQ(claimed_shape(1, without), std::nullopt);
}

TEST(ViewCodecTest, EqualViewsHaveEqualBytes) {
  EXPECT_EQ(encode_view(testing::random_view(7, 360, 90)),
            encode_view(testing::random_view(7, 360, 90)));
}

TEST(ViewCodecTest, OneColumnRepeatedTakesNextToNothing) {
  const ColumnView view = ColumnView::from_labels(LabelImage(90, 360, 3));
  EXPECT_LT(encode_view(view).size(), 40U);
}

TEST(ViewCodecTest, AnotherShapeIsRefused) {
  const std::vector<std::byte> bytes = encode_view(testing::random_view(2, 120, 20));
  for (const auto& [columns, rows] : {std::pair(119, 20), {121, 20}, {120, 19}, {1, 1}, {0, 0}}) {
    const auto decoded = decode_view(kViewCodec, bytes, {columns, rows, false});
    ASSERT_FALSE(decoded.has_value());
    EXPECT_EQ(decoded.error().code, ErrorCode::kDataLoss);
  }
}

// Damage gives an error or a sound view of the right shape, never anything else. (Which of the two
// is the record's checksum's business.)
TEST(ViewCodecTest, DamagedBytesNeverDoHarm) {
  const std::vector<std::byte> labels = encode_view(testing::random_view(3, 120, 20));
  const std::vector<std::byte> ranges = encode_view(testing::random_view_with_ranges(3, 120, 20));
  Rng rng(5, "damage");
  for (int i = 0; i < 3000; ++i) {
    std::vector<std::byte> bytes = i % 2 == 0 ? labels : ranges;
    const std::uint64_t flips = 1 + rng.below(4);
    for (std::uint64_t k = 0; k < flips; ++k) {
      bytes[rng.below(bytes.size())] ^= static_cast<std::byte>(1U << rng.below(8));
    }
    if (rng.uniform() < 0.2) bytes.resize(rng.below(bytes.size()));
    if (const auto decoded = decode_view(kViewCodec, bytes, {120, 20, i % 2 == 1})) {
      EXPECT_EQ(decoded->columns(), 120);
      EXPECT_EQ(decoded->rows(), 20);
    }
  }
}

TEST(ViewCodecTest, RandomBytesAreNoView) {
  Rng rng(6, "noise");
  for (int i = 0; i < 500; ++i) {
    std::vector<std::byte> bytes(rng.below(200));
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(rng.below(256));
    EXPECT_FALSE(decode_view(kViewCodec, bytes, {120, 20, false}).has_value());
  }
}

}  // namespace
}  // namespace semview
