// SPDX-License-Identifier: Apache-2.0
/// The symbols of a view on their way to bytes and back; for the sources of this module.
///
/// Writer and reader have the same `code` and `plain`, so that one walk drives both. What an edge
/// does next is known to the reader before it happens, so the writer leaves a symbol open and fills
/// it in once the walk has come there.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "semview/view/range_coder.hpp"
#include "semview/view/view_situations.hpp"

namespace semview::detail {

/// A number of columns as a symbol and some plain bits: up to 12 as they are, then in parts that
/// double.
struct GapCode {
  std::uint32_t symbol = 0;
  std::uint32_t plain = 0;

  static constexpr std::uint32_t kExact = 12;
  static constexpr unsigned kLastBits = 12;

  static GapCode of(std::uint32_t gap) {
    if (gap <= kExact) return {gap, 0};
    const std::uint32_t beyond = gap - kExact - 1;
    const auto part = static_cast<std::uint32_t>(std::bit_width((beyond >> 2U) + 1)) - 1;
    const std::uint32_t symbol = std::min(kExact + 1 + part, kGapSymbols - 1);
    return {symbol, gap - first_of(symbol)};
  }
  static unsigned bits_of(std::uint32_t symbol) {
    if (symbol <= kExact) return 0;
    return symbol == kGapSymbols - 1 ? kLastBits : symbol - kExact + 1;
  }
  static std::uint32_t first_of(std::uint32_t symbol) {
    return symbol <= kExact ? symbol : kExact + 1 + ((4U << (symbol - kExact - 1)) - 4U);
  }
};

class SymbolWriter {
 public:
  static constexpr bool kDecodes = false;

  struct Symbol {
    std::uint16_t situation;
    std::uint16_t symbol;
    std::uint16_t plain_bits;
    std::uint16_t plain;
  };

  /// For at most so many symbols.
  explicit SymbolWriter(std::size_t most)
      : symbols_(std::make_unique_for_overwrite<Symbol[]>(most)) {}

  std::uint32_t code(Situation situation, std::uint32_t symbol) {
    symbols_[count_++] = {
        static_cast<std::uint16_t>(situation), static_cast<std::uint16_t>(symbol), 0, 0};
    return symbol;
  }
  /// Goes with the symbol before it; at most 16 bits.
  std::uint32_t plain(std::uint32_t value, unsigned bits) {
    symbols_[count_ - 1].plain = static_cast<std::uint16_t>(value);
    symbols_[count_ - 1].plain_bits = static_cast<std::uint16_t>(bits);
    return value;
  }
  /// A gap not known yet, 0 if it never will be. @returns what names it.
  std::uint32_t open_gap(Situation situation) {
    code(situation, 0);
    return static_cast<std::uint32_t>(count_) - 1;
  }
  void close_gap(std::uint32_t name, std::uint32_t gap) {
    const GapCode coded = GapCode::of(gap);
    Symbol& symbol = symbols_[name];
    symbol.symbol = static_cast<std::uint16_t>(coded.symbol);
    symbol.plain = static_cast<std::uint16_t>(coded.plain);
    symbol.plain_bits = static_cast<std::uint16_t>(GapCode::bits_of(coded.symbol));
  }
  std::span<const Symbol> symbols() const { return {symbols_.get(), count_}; }
  void write(RangeEncoder& encoder) const {
    Interval interval = encoder.interval();
    for (const Symbol& symbol : symbols()) {
      encoder.code(interval, kViewShares.share(symbol.situation, symbol.symbol));
      if (symbol.plain_bits > 0) encoder.code_few(interval, symbol.plain, symbol.plain_bits);
    }
    encoder.go_on_from(interval);
  }

 private:
  std::unique_ptr<Symbol[]> symbols_;
  std::size_t count_ = 0;
};

class SymbolReader {
 public:
  static constexpr bool kDecodes = true;

  explicit SymbolReader(RangeDecoder& decoder) : decoder_(decoder) {}

  std::uint32_t code(Situation situation, std::uint32_t /*symbol*/) {
    const std::uint32_t symbol = kViewShares.symbol_at(situation, decoder_.place());
    decoder_.take(kViewShares.share(situation, symbol));
    return symbol;
  }
  std::uint32_t plain(std::uint32_t value, unsigned bits) {
    return decoder_.code_plain(value, bits);
  }

 private:
  RangeDecoder& decoder_;
};

}  // namespace semview::detail
