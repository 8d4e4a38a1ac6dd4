// SPDX-License-Identifier: Apache-2.0
/// Binary arithmetic coding with adaptive probabilities; for the sources of this module.
///
/// Encoder and decoder have the same members, so that one model, written once as a template, drives
/// both: `code` takes the bit to write and gives back the bit that was written or read.
/// docs/formats/cache_record.md#codec-2 has the arithmetic, bit by bit.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace semview::detail {

/// How likely the next bit in one situation is a 1, of 2^16; learns from each bit.
class AdaptiveBit {
 public:
  /// Of 2^16; 31 <= probability < 2^16 - 31.
  explicit AdaptiveBit(std::uint16_t probability = 1U << 15U) : probability_(probability) {}

  /// Stays within 31 and 2^16 - 31, so that neither bit ever becomes impossible.
  void learn(bool bit) {
    probability_ = static_cast<std::uint16_t>(bit ? probability_ + ((kOne - probability_) >> kRate)
                                                  : probability_ - (probability_ >> kRate));
  }
  /// Where [low, high] is cut: up to and including it the bit is a 1.
  std::uint32_t cut(std::uint32_t low, std::uint32_t high) const {
    return low + static_cast<std::uint32_t>((std::uint64_t{high - low} * probability_) >> 16U);
  }

 private:
  static constexpr std::uint32_t kOne = 1U << 16U;
  static constexpr unsigned kRate = 5;
  std::uint16_t probability_;
};

class RangeEncoder {
 public:
  static constexpr bool kDecodes = false;

  bool code(AdaptiveBit& situation, bool bit) {
    narrow(situation.cut(low_, high_), bit);
    situation.learn(bit);
    return bit;
  }
  /// The lowest `count` bits of `value`, each as likely 0 as 1, the highest first.
  std::uint32_t code_plain(std::uint32_t value, unsigned count) {
    for (unsigned k = count; k-- > 0;) {
      narrow(low_ + ((high_ - low_) >> 1U), ((value >> k) & 1U) != 0);
    }
    return value;
  }
  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
  /// The fewest bytes that name a number in the interval; zeros follow by themselves.
  std::vector<std::byte> finish() && {
    for (unsigned kept = 8; kept <= 32; kept += 8) {
      const std::uint32_t rest = kept == 32 ? 0U : ~0U >> kept;
      if (low_ > ~rest) continue;
      const std::uint32_t number = (low_ + rest) & ~rest;
      if (number > high_) continue;
      for (unsigned shift = 24; shift + kept >= 32; shift -= 8) {
        bytes_.push_back(static_cast<std::byte>((number >> shift) & 0xffU));
        if (shift == 0) break;
      }
      break;
    }
    while (!bytes_.empty() && bytes_.back() == std::byte{0}) bytes_.pop_back();
    return std::move(bytes_);
  }

 private:
  void narrow(std::uint32_t cut, bool bit) {
    high_ = bit ? cut : high_;
    low_ = bit ? low_ : cut + 1;
    while (((low_ ^ high_) >> 24U) == 0) {
      bytes_.push_back(static_cast<std::byte>(high_ >> 24U));
      low_ <<= 8U;
      high_ = (high_ << 8U) | 0xffU;
    }
  }

  std::uint32_t low_ = 0;
  std::uint32_t high_ = ~0U;
  std::vector<std::byte> bytes_;
};

/// Reads any bytes; past their end there are zeros.
class RangeDecoder {
 public:
  static constexpr bool kDecodes = true;

  explicit RangeDecoder(std::span<const std::byte> bytes) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) take_byte();
  }

  bool code(AdaptiveBit& situation, bool /*bit*/) {
    const bool bit = narrow(situation.cut(low_, high_));
    situation.learn(bit);
    return bit;
  }
  std::uint32_t code_plain(std::uint32_t /*value*/, unsigned count) {
    std::uint32_t value = 0;
    for (; count > 0; --count) {
      value = 2 * value + (narrow(low_ + ((high_ - low_) >> 1U)) ? 1U : 0U);
    }
    return value;
  }
  /// Whether every byte was needed, as after `RangeEncoder::finish`.
  bool finished() const { return next_ >= bytes_.size(); }

 private:
  bool narrow(std::uint32_t cut) {
    const bool bit = number_ <= cut;
    high_ = bit ? cut : high_;
    low_ = bit ? low_ : cut + 1;
    while (((low_ ^ high_) >> 24U) == 0) {
      low_ <<= 8U;
      high_ = (high_ << 8U) | 0xffU;
      take_byte();
    }
    return bit;
  }
  void take_byte() {
    number_ <<= 8U;
    if (next_ < bytes_.size()) number_ |= static_cast<std::uint32_t>(bytes_[next_++]);
  }

  std::span<const std::byte> bytes_;
  std::size_t next_ = 0;
  std::uint32_t low_ = 0;
  std::uint32_t high_ = ~0U;
  std::uint32_t number_ = 0;
};

}  // namespace semview::detail
