// SPDX-License-Identifier: Apache-2.0
/// Arithmetic coding of symbols and of bits; for the sources of this module.
///
/// Encoder and decoder have the same members for bits, so that one model of them, written once as
/// a template, drives both: `code` takes the bit to write and gives back the bit that was written
/// or read. docs/formats/cache_record.md#codec-2 has the arithmetic.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace semview::detail {

/// How likely the next bit in one situation is a 1, of 2^16; learns from each bit.
class AdaptiveBit {
 public:
  /// Stays within 31 and 2^16 - 31, so that neither bit ever becomes impossible.
  void learn(bool bit) {
    probability_ = static_cast<std::uint16_t>(bit ? probability_ + ((kOne - probability_) >> kRate)
                                                  : probability_ - (probability_ >> kRate));
  }
  std::uint64_t probability() const { return probability_; }

  static constexpr unsigned kProbabilityBits = 16;

 private:
  static constexpr std::uint32_t kOne = 1U << kProbabilityBits;
  static constexpr unsigned kRate = 5;
  std::uint16_t probability_ = kOne / 2;
};

/// The part of an interval that a symbol takes: [start, start + size) of 2^kShareBits.
struct Share {
  std::uint32_t start = 0;
  std::uint32_t size = 0;  ///< at least 1
};
inline constexpr unsigned kShareBits = 12;

/// Below this an interval is widened by four bytes. Nothing codes with shares of less than 2^-16,
/// so it has been widened enough then.
inline constexpr std::uint64_t kNarrow = std::uint64_t{1} << 32U;

/// The numbers that begin with what has been coded, behind the bytes that are written already.
struct Interval {
  std::uint64_t low = 0;
  std::uint64_t size = ~std::uint64_t{0};
};

class RangeEncoder {
 public:
  static constexpr bool kDecodes = false;

  void code(Share share) { code(interval_, share); }
  bool code(AdaptiveBit& situation, bool bit) {
    const std::uint64_t unit = interval_.size >> AdaptiveBit::kProbabilityBits;
    const std::uint64_t cut = unit * situation.probability();
    narrow(interval_, bit ? 0 : cut, bit ? cut : interval_.size - cut);
    situation.learn(bit);
    return bit;
  }
  /// The lowest `count` bits of `value`, each as likely 0 as 1.
  std::uint32_t code_plain(std::uint32_t value, unsigned count) {
    for (; count > 16; count -= 16) code_few(interval_, value >> (count - 16), 16);
    code_few(interval_, value, count);
    return value;
  }

  // To code much at once: an interval of the caller's stays in registers.
  Interval interval() const { return interval_; }
  void go_on_from(const Interval& interval) { interval_ = interval; }
  void code(Interval& interval, Share share) {
    const std::uint64_t unit = interval.size >> kShareBits;
    narrow(interval, unit * share.start, unit * share.size);
  }
  /// As `code_plain`, at most 16 bits.
  void code_few(Interval& interval, std::uint32_t value, unsigned count) {
    const std::uint64_t unit = interval.size >> count;
    narrow(interval, unit * (value & ((1U << count) - 1U)), unit);
  }

  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
  /// The fewest bytes that name a number in the interval; zeros follow by themselves.
  std::vector<std::byte> finish() && {
    const auto& [low, size] = interval_;
    for (unsigned bytes = 1; bytes <= 8; ++bytes) {
      const std::uint64_t rest = bytes == 8 ? 0 : ~std::uint64_t{0} >> (8 * bytes);
      const std::uint64_t number = (low + rest) & ~rest;
      if (number - low >= size) continue;
      if (number < low) carry();
      for (unsigned i = 0; i < bytes; ++i) bytes_.push_back(byte_of(number, i));
      break;
    }
    while (!bytes_.empty() && bytes_.back() == std::byte{0}) bytes_.pop_back();
    return std::move(bytes_);
  }

 private:
  void narrow(Interval& interval, std::uint64_t start, std::uint64_t size) {
    interval.low += start;
    if (interval.low < start) carry();
    interval.size = size;
    if (size >= kNarrow) return;
    write_word(interval.low);
    interval.low <<= 32U;
    interval.size <<= 32U;
  }
  void write_word(std::uint64_t low) {
    const std::size_t end = bytes_.size();
    bytes_.resize(end + 4);
    for (unsigned i = 0; i < 4; ++i) bytes_[end + i] = byte_of(low, i);
  }
  void carry() {
    // What has been coded is below 1, so some byte takes it.
    std::size_t i = bytes_.size();
    while (bytes_[i - 1] == std::byte{0xff}) bytes_[--i] = std::byte{0};
    bytes_[i - 1] = static_cast<std::byte>(static_cast<unsigned>(bytes_[i - 1]) + 1U);
  }
  /// From the highest.
  static std::byte byte_of(std::uint64_t number, unsigned i) {
    return static_cast<std::byte>((number >> (56 - 8 * i)) & 0xffU);
  }

  Interval interval_;
  std::vector<std::byte> bytes_;
};

/// Reads any bytes; past their end there are zeros.
class RangeDecoder {
 public:
  static constexpr bool kDecodes = true;

  explicit RangeDecoder(std::span<const std::byte> bytes) : bytes_(bytes) {
    take_bytes();
    take_bytes();
  }

  /// Where in [0, 2^kShareBits) the next symbol's share lies; `take` it then.
  std::uint32_t place() const {
    // Bytes that nobody wrote may lie behind the last share.
    constexpr std::uint64_t kLast = (1U << kShareBits) - 1U;
    return static_cast<std::uint32_t>(std::min(number_ / (size_ >> kShareBits), kLast));
  }
  void take(Share share) {
    const std::uint64_t unit = size_ >> kShareBits;
    narrow(unit * share.start, unit * share.size);
  }
  bool code(AdaptiveBit& situation, bool /*bit*/) {
    const std::uint64_t cut = (size_ >> AdaptiveBit::kProbabilityBits) * situation.probability();
    const bool bit = number_ < cut;
    narrow(bit ? 0 : cut, bit ? cut : size_ - cut);
    situation.learn(bit);
    return bit;
  }
  std::uint32_t code_plain(std::uint32_t /*value*/, unsigned count) {
    std::uint32_t value = 0;
    for (; count > 16; count -= 16) value = value << 16U | decode_few(16);
    return value << count | decode_few(count);
  }
  /// Whether every byte was needed, as after `RangeEncoder::finish`.
  bool finished() const { return next_ >= bytes_.size(); }

 private:
  std::uint32_t decode_few(unsigned count) {
    const std::uint64_t unit = size_ >> count;
    const std::uint64_t last = (std::uint64_t{1} << count) - 1;
    const std::uint64_t value = std::min(number_ / unit, last);
    narrow(unit * value, unit);
    return static_cast<std::uint32_t>(value);
  }
  void narrow(std::uint64_t start, std::uint64_t size) {
    number_ -= start;
    size_ = size;
    if (size_ >= kNarrow) return;
    size_ <<= 32U;
    take_bytes();
  }
  void take_bytes() {
    for (int i = 0; i < 4; ++i) {
      number_ <<= 8U;
      if (next_ < bytes_.size()) number_ |= static_cast<std::uint64_t>(bytes_[next_++]);
    }
  }

  std::span<const std::byte> bytes_;
  std::size_t next_ = 0;
  std::uint64_t size_ = ~std::uint64_t{0};
  std::uint64_t number_ = 0;  // of the interval, from its start
};

}  // namespace semview::detail
