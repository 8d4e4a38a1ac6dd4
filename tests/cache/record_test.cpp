// SPDX-License-Identifier: Apache-2.0
#include "semview/cache/record.hpp"

#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "semview/core/hash.hpp"
#include "support/cache_samples.hpp"

namespace semview::cache {
namespace {

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

std::vector<std::byte> sample_record() {
  return encode_record({digest(test_keyspace()), {-3, 5}}, 2, bytes_of("payload"));
}

/// The same bytes with a checksum that fits them again.
std::vector<std::byte> resealed(std::vector<std::byte> bytes) {
  bytes.resize(bytes.size() - 8);
  const std::uint64_t checksum = hash64(bytes);
  for (unsigned shift = 0; shift < 64; shift += 8) {
    bytes.push_back(static_cast<std::byte>((checksum >> shift) & 0xffU));
  }
  return bytes;
}

TEST(RecordTest, HoldsItsKeyAndPayload) {
  const std::vector<std::byte> bytes = sample_record();
  const auto record = decode_record(bytes);
  ASSERT_TRUE(record.has_value()) << record.error().message;
  EXPECT_EQ(record->key, (ViewKey{digest(test_keyspace()), {-3, 5}}));
  EXPECT_EQ(record->codec, 2);
  EXPECT_TRUE(std::ranges::equal(record->payload, bytes_of("payload")));
}

// docs/formats/cache_record.md, byte by byte: independent of the encoder.
TEST(RecordTest, HasTheDocumentedBytes) {
  const std::vector<std::byte> bytes = sample_record();
  const Fingerprint name = digest(test_keyspace());
  std::string expected = "SVWR" + std::string("\x02\x00", 2);
  expected.append(reinterpret_cast<const char*>(name.bytes.data()), name.bytes.size());
  expected += std::string("\x80\0\0\x05\x7f\xff\xff\xfd", 8);  // iy, ix
  expected += std::string("\x02\x07", 2) + "payload";
  ASSERT_EQ(bytes.size(), expected.size() + 8);
  EXPECT_EQ(std::memcmp(bytes.data(), expected.data(), expected.size()), 0);
}

TEST(RecordTest, EveryFlippedBitIsSeen) {
  const std::vector<std::byte> sound = sample_record();
  for (std::size_t i = 0; i < sound.size(); ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::vector<std::byte> bytes = sound;
      bytes[i] ^= static_cast<std::byte>(1U << bit);
      const auto record = decode_record(bytes);
      ASSERT_FALSE(record.has_value()) << "byte " << i << " bit " << bit;
      const bool in_format = i == 4 || i == 5;
      EXPECT_EQ(record.error().code, in_format ? ErrorCode::kUnimplemented : ErrorCode::kDataLoss);
    }
  }
}

TEST(RecordTest, EveryCutIsSeen) {
  const std::vector<std::byte> sound = sample_record();
  for (std::size_t size = 0; size < sound.size(); ++size) {
    EXPECT_FALSE(decode_record(std::span(sound).first(size)).has_value());
  }
  std::vector<std::byte> longer = sound;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(decode_record(longer).has_value());
}

TEST(RecordTest, AWrongLengthUnderAGoodChecksumIsSeen) {
  std::vector<std::byte> bytes = sample_record();
  for (const unsigned length : {0U, 6U, 8U, 0x7fU, 0x80U, 0xffU}) {
    bytes[31] = static_cast<std::byte>(length);
    EXPECT_FALSE(decode_record(resealed(bytes)).has_value()) << length;
  }
}

TEST(RecordTest, NegativeZeroIsTheSameKey) {
  Keyspace keyspace = test_keyspace();
  keyspace.profile.camera.elevation_min_rad = 0.0;
  Keyspace negative = keyspace;
  negative.profile.camera.elevation_min_rad = -0.0;
  EXPECT_EQ(to_bytes(keyspace), to_bytes(negative));
  EXPECT_EQ(digest(keyspace), digest(negative));
}

}  // namespace
}  // namespace semview::cache
