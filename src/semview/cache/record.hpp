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
inline constexpr std::uint16_t kRecordFormat = 1;

/// Whose view a record holds, and its payload (a part of the record's bytes).
struct Record {
  Keyspace keyspace;
  CellIndex cell;
  std::uint8_t codec = 0;
  std::span<const std::byte> payload;
};

/// `keyspace_bytes` is `to_bytes(keyspace)`, made once for many records.
std::vector<std::byte> encode_record(std::span<const std::byte> keyspace_bytes,
                                     const CellIndex& cell,
                                     std::uint8_t codec,
                                     std::span<const std::byte> payload);

/// @errors kDataLoss: magic, length or checksum is wrong; kUnimplemented: a format that this
/// program does not know.
Result<Record> decode_record(std::span<const std::byte> bytes);

/// The length that the record at the front of `bytes` has by its own words, which may be wrong; 0
/// if it is cut before they end.
std::size_t record_length(std::span<const std::byte> bytes);

}  // namespace semview::cache
