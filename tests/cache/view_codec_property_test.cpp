// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
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
    const auto decoded = decode_view(encode_view(view), columns, rows);
    RC_ASSERT(decoded.has_value());
    RC_ASSERT(*decoded == view);
  }));
}

TEST(ViewCodecTest, CodesTheLargestPanorama) {
  const ColumnView view = testing::random_view(1, 3600, 1024);
  const auto decoded = decode_view(encode_view(view), 3600, 1024);
  ASSERT_TRUE(decoded.has_value());
  EXPECT_EQ(*decoded, view);
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
    const auto decoded = decode_view(bytes, columns, rows);
    ASSERT_FALSE(decoded.has_value());
    EXPECT_EQ(decoded.error().code, ErrorCode::kDataLoss);
  }
}

// Damage gives an error or a sound view of the right shape, never anything else. (Which of the two
// is the record's checksum's business.)
TEST(ViewCodecTest, DamagedBytesNeverDoHarm) {
  const std::vector<std::byte> sound = encode_view(testing::random_view(3, 120, 20));
  Rng rng(5, "damage");
  for (int i = 0; i < 3000; ++i) {
    std::vector<std::byte> bytes = sound;
    const std::uint64_t flips = 1 + rng.below(4);
    for (std::uint64_t k = 0; k < flips; ++k) {
      bytes[rng.below(bytes.size())] ^= static_cast<std::byte>(1U << rng.below(8));
    }
    if (rng.uniform() < 0.2) bytes.resize(rng.below(bytes.size()));
    if (const auto decoded = decode_view(bytes, 120, 20)) {
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
    EXPECT_FALSE(decode_view(bytes, 120, 20).has_value());
  }
}

}  // namespace
}  // namespace semview
