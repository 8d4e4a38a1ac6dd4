// SPDX-License-Identifier: Apache-2.0
#include "semview/core/hash.hpp"

#include <bit>
#include <utility>

#include <fmt/format.h>
#include <xxhash.h>

namespace semview {
namespace {

template <typename Unsigned>
void add_little_endian(Hasher& hasher, Unsigned value) {
  std::array<std::byte, sizeof(Unsigned)> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::byte>((value >> (8 * i)) & 0xff);
  }
  hasher.add_bytes(bytes);
}

}  // namespace

struct Hasher::State {
  XXH3_state_t* xxh = XXH3_createState();
  State() { XXH3_128bits_reset(xxh); }
  ~State() { XXH3_freeState(xxh); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

Hasher::Hasher() : state_(std::make_unique<State>()) {}
Hasher::~Hasher() = default;
Hasher::Hasher(Hasher&&) noexcept = default;
Hasher& Hasher::operator=(Hasher&&) noexcept = default;

void Hasher::add_bytes(std::span<const std::byte> bytes) {
  XXH3_128bits_update(state_->xxh, bytes.data(), bytes.size());
}
void Hasher::add_u32(std::uint32_t value) { add_little_endian(*this, value); }
void Hasher::add_u64(std::uint64_t value) { add_little_endian(*this, value); }
void Hasher::add_f64(double value) {
  add_u64(std::bit_cast<std::uint64_t>(value == 0.0 ? 0.0 : value));
}
void Hasher::add_string(std::string_view text) {
  add_u64(text.size());
  add_bytes(std::as_bytes(std::span(text)));
}

Fingerprint Hasher::digest() const {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_->xxh));
  Fingerprint fingerprint;
  for (std::size_t i = 0; i < fingerprint.bytes.size(); ++i) {
    fingerprint.bytes[i] = canonical.digest[i];
  }
  return fingerprint;
}

std::string to_hex(const Fingerprint& fingerprint) {
  std::string hex;
  for (const std::uint8_t byte : fingerprint.bytes) hex += fmt::format("{:02x}", byte);
  return hex;
}

std::uint64_t hash64(std::span<const std::byte> bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace semview
