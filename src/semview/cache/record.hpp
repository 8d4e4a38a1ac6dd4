// SPDX-License-Identifier: Apache-2.0
/// The bytes of one stored view: docs/formats/cache_record.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "semview/cache/cache_key.hpp"
#include "semview/core/result.hpp"

namespace semview::cache {

inline constexpr std::array kRecordMagic = {
    std::byte{'S'}, std::byte{'V'}, std::byte{'W'}, std::byte{'R'}};
/// The format that is written; `decode_record` reads it and format 1.
inline constexpr std::uint16_t kRecordFormat = 2;

/// Digest and cell, the key under which LMDB holds a record; keys in byte order are cells row by
/// row.
using RecordKey = std::array<std::byte, 24>;
RecordKey record_key(const ViewKey& key);

/// Whose view a record holds, and its payload (a part of the record's bytes).
struct Record {
  ViewKey key;
  std::uint8_t codec = 0;
  std::span<const std::byte> payload;
};

std::vector<std::byte> encode_record(const ViewKey& key,
                                     std::uint8_t codec,
                                     std::span<const std::byte> payload);

/// @errors kDataLoss: magic, length or checksum is wrong; kUnimplemented: a format that this
/// program does not know.
Result<Record> decode_record(std::span<const std::byte> bytes);

/// The length that the record at the front of `bytes` has by its own words, which may be wrong; 0
/// if it is cut before they end.
std::size_t record_length(std::span<const std::byte> bytes);

}  // namespace semview::cache
