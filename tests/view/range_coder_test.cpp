// SPDX-License-Identifier: Apache-2.0
#include "semview/view/range_coder.hpp"

#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "semview/core/random.hpp"
#include "semview/view/view_situations.hpp"
#include "semview/view/view_symbols.hpp"

namespace semview::detail {
namespace {

/// Something to code: a share, a bit that is likelier yes or no, or plain bits.
struct Item {
  int kind = 0;
  Share share;
  bool yes = false;
  std::uint32_t plain = 0;
  unsigned bits = 0;
};

std::vector<Item> random_items(Rng& rng, double extreme) {
  constexpr std::uint32_t kWhole = 1U << kShareBits;
  std::vector<Item> items(rng.below(600));
  for (Item& item : items) {
    item.kind = static_cast<int>(rng.below(3));
    // Shares at the very end keep the sum all ones, so that carries run far.
    item.share.size =
        rng.uniform() < extreme ? 1 : 1 + static_cast<std::uint32_t>(rng.below(kWhole));
    const std::uint32_t room = kWhole - item.share.size;
    item.share.start =
        rng.uniform() < extreme ? room : static_cast<std::uint32_t>(rng.below(room + 1));
    item.yes = rng.uniform() < extreme;
    item.bits = static_cast<unsigned>(rng.below(33));
    item.plain = item.bits == 0 ? 0
                                : (rng.uniform() < extreme
                                       ? ~0U
                                       : static_cast<std::uint32_t>(rng.below(1ULL << 32U))) >>
                                      (32 - item.bits);
  }
  return items;
}

TEST(RangeCoderTest, ReadsWhatWasWrittenAndNeedsEveryByte) {
  EXPECT_TRUE(rc::check([] {
    Rng rng(*rc::gen::arbitrary<std::uint64_t>(), "items");
    const std::vector<Item> items = random_items(rng, rng.uniform());
    RangeEncoder encoder;
    AdaptiveBit situation;
    for (const Item& item : items) {
      if (item.kind == 0) encoder.code(item.share);
      if (item.kind == 1) encoder.code(situation, item.yes);
      if (item.kind == 2) encoder.code_plain(item.plain, item.bits);
    }
    const std::vector<std::byte> bytes = std::move(encoder).finish();
    RangeDecoder decoder(bytes);
    situation = AdaptiveBit();
    for (const Item& item : items) {
      if (item.kind == 0) {
        RC_ASSERT(decoder.place() >= item.share.start);
        RC_ASSERT(decoder.place() < item.share.start + item.share.size);
        decoder.take(item.share);
      }
      if (item.kind == 1) RC_ASSERT(decoder.code(situation, false) == item.yes);
      if (item.kind == 2) RC_ASSERT(decoder.code_plain(0, item.bits) == item.plain);
    }
    RC_ASSERT(decoder.finished());
    // RC_ASSERT looks at both sides of an ||.
    if (!bytes.empty()) RC_ASSERT(bytes.back() != std::byte{0});
  }));
}

TEST(RangeCoderTest, ReadsAnyBytesWithoutHarm) {
  Rng rng(3, "noise");
  for (int i = 0; i < 300; ++i) {
    std::vector<std::byte> bytes(rng.below(40));
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(i % 2 == 0 ? 0xff : rng.below(256));
    RangeDecoder decoder(bytes);
    AdaptiveBit situation;
    for (int k = 0; k < 200; ++k) {
      const auto of = static_cast<Situation>(rng.below(ViewSituations::kCount));
      const std::uint32_t symbol = kViewShares.symbol_at(of, decoder.place());
      ASSERT_LT(symbol, symbols_of(of));
      decoder.take(kViewShares.share(of, symbol));
      ASSERT_LT(decoder.code_plain(0, 7), 128U);
      decoder.code(situation, false);
    }
  }
}

TEST(GapCodeTest, NamesEveryGapOnce) {
  std::uint32_t symbol = 0;
  for (std::uint32_t gap = 0; gap <= 3600; ++gap) {
    const GapCode coded = GapCode::of(gap);
    ASSERT_LT(coded.symbol, kGapSymbols);
    ASSERT_EQ(GapCode::first_of(coded.symbol) + coded.plain, gap);
    ASSERT_EQ(coded.plain >> GapCode::bits_of(coded.symbol), 0U) << gap;
    ASSERT_GE(coded.symbol, symbol) << gap;
    symbol = coded.symbol;
  }
}

}  // namespace
}  // namespace semview::detail
