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
  return encode_record(to_bytes(test_keyspace()), {-3, 5}, 1, bytes_of("payload"));
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

TEST(RecordTest, HoldsItsFullKeyAndPayload) {
  const std::vector<std::byte> bytes = sample_record();
  const auto record = decode_record(bytes);
  ASSERT_TRUE(record.has_value()) << record.error().message;
  EXPECT_EQ(record->keyspace, test_keyspace());
  EXPECT_EQ(record->cell, (CellIndex{-3, 5}));
  EXPECT_EQ(record->codec, 1);
  EXPECT_TRUE(std::ranges::equal(record->payload, bytes_of("payload")));
}

// docs/formats/cache_record.md, byte by byte: independent of the encoder.
TEST(RecordTest, HasTheDocumentedBytes) {
  const std::vector<std::byte> bytes = sample_record();
  const std::string head = "SVWR" + std::string("\x01\x00", 2) + std::string("\x35\x00", 2) +
                           std::string(16, '\x01') + "\x04test" + std::string("\x03\0\0\0", 4) +
                           std::string("\x78\x00\x0c\x00", 4);
  ASSERT_EQ(bytes.size(), 8U + 53U + 4 + 4 + 1 + 4 + 7 + 8);
  EXPECT_EQ(std::memcmp(bytes.data(), head.data(), head.size()), 0);
  const std::string tail = std::string("\xfd\xff\xff\xff\x05\0\0\0\x01\x07\0\0\0", 13) + "payload";
  EXPECT_EQ(std::memcmp(bytes.data() + 61, tail.data(), tail.size()), 0);
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
  bytes[70] = std::byte{200};  // payload length
  EXPECT_FALSE(decode_record(resealed(bytes)).has_value());
  bytes = sample_record();
  bytes[6] = std::byte{255};  // key length
  EXPECT_FALSE(decode_record(resealed(bytes)).has_value());
  bytes = sample_record();
  bytes[8 + 16] = std::byte{200};  // engine name length
  EXPECT_FALSE(decode_record(resealed(bytes)).has_value());
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
