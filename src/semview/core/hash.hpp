// SPDX-License-Identifier: Apache-2.0
/// Stable content hashes (XXH3): the same bytes give the same value on every machine.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace semview {

/// A 128-bit content hash: the identity of a map's canonical content.
struct Fingerprint {
  std::array<std::uint8_t, 16> bytes{};

  auto operator<=>(const Fingerprint&) const = default;  // NOLINT(modernize-use-nullptr): its own 0
};

/// 32 lower-case hexadecimal digits.
std::string to_hex(const Fingerprint& fingerprint);

/// XXH3-64 of `bytes`, the checksum of stored records.
std::uint64_t hash64(std::span<const std::byte> bytes);

/// Feeds values to XXH3-128, numbers as little-endian fixed-width bytes.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(Hasher&&) noexcept;
  Hasher& operator=(Hasher&&) noexcept;

  void add_bytes(std::span<const std::byte> bytes);
  void add_u32(std::uint32_t value);
  void add_u64(std::uint64_t value);
  /// -0.0 counts as 0.0.
  void add_f64(double value);
  /// Length first, so that ("ab", "c") differs from ("a", "bc").
  void add_string(std::string_view text);

  Fingerprint digest() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace semview
