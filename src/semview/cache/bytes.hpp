// SPDX-License-Identifier: Apache-2.0
/// Little-endian numbers in stored records; for the sources of this module.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace semview::cache::detail {

class ByteWriter {
 public:
  template <typename Integer>
  void add(Integer value) {
    const auto bits = static_cast<std::make_unsigned_t<Integer>>(value);
    for (std::size_t i = 0; i < sizeof(bits); ++i) {
      bytes_.push_back(static_cast<std::byte>((bits >> (8 * i)) & 0xff));
    }
  }
  /// 7 bits a byte from the lowest, the top bit set on all but the last byte.
  void add_varint(std::uint32_t value) {
    for (; value >= 0x80; value >>= 7U) add(static_cast<std::uint8_t>(0x80U | (value & 0x7fU)));
    add(static_cast<std::uint8_t>(value));
  }
  /// -0.0 as 0.0, so that equal keys have equal bytes.
  void add_f64(double value) { add(std::bit_cast<std::uint64_t>(value == 0.0 ? 0.0 : value)); }
  void add_bytes(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
  const std::vector<std::byte>& bytes() const { return bytes_; }
  std::vector<std::byte> take() && { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Reads from the front; past the end everything is 0 and `failed()`.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <typename Integer>
  Integer take() {
    using Bits = std::make_unsigned_t<Integer>;
    Bits bits = 0;
    const std::span<const std::byte> bytes = take_bytes(sizeof(Bits));
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      bits = static_cast<Bits>(bits | static_cast<Bits>(static_cast<Bits>(bytes[i]) << (8 * i)));
    }
    return static_cast<Integer>(bits);
  }
  std::uint32_t take_varint() {
    std::uint32_t value = 0;
    for (unsigned shift = 0; shift < 32; shift += 7) {
      const auto part = take<std::uint8_t>();
      value |= (part & 0x7fU) << shift;
      if ((part & 0x80U) == 0) return value;
    }
    failed_ = true;
    return 0;
  }
  double take_f64() { return std::bit_cast<double>(take<std::uint64_t>()); }
  std::span<const std::byte> take_bytes(std::size_t count) {
    if (count > bytes_.size()) {
      failed_ = true;
      return {};
    }
    const std::span<const std::byte> part = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return part;
  }
  std::string take_string(std::size_t count) {
    const std::span<const std::byte> bytes = take_bytes(count);
    std::string text(bytes.size(), '\0');
    if (!bytes.empty()) std::memcpy(text.data(), bytes.data(), bytes.size());
    return text;
  }
  std::size_t left() const { return bytes_.size(); }
  bool failed() const { return failed_; }

 private:
  std::span<const std::byte> bytes_;
  bool failed_ = false;
};

}  // namespace semview::cache::detail
