// SPDX-License-Identifier: Apache-2.0
#include "semview/cache/record.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "semview/cache/bytes.hpp"

namespace semview::cache {
namespace {

constexpr std::size_t kChecksumBytes = 8;

void add_big_endian(std::byte*& out, std::int32_t value) {
  // The sign bit flipped: negative cells come first in byte order.
  const std::uint32_t bits = static_cast<std::uint32_t>(value) ^ 0x80000000U;
  for (unsigned shift = 32; shift > 0; shift -= 8) {
    *out++ = static_cast<std::byte>((bits >> (shift - 8)) & 0xffU);
  }
}

std::int32_t take_big_endian(detail::ByteReader& in) {
  std::uint32_t bits = 0;
  for (int i = 0; i < 4; ++i) bits = (bits << 8U) | in.take<std::uint8_t>();
  return static_cast<std::int32_t>(bits ^ 0x80000000U);
}

void take_digest(detail::ByteReader& in, Fingerprint& name) {
  std::ranges::transform(in.take_bytes(name.bytes.size()), name.bytes.begin(), [](std::byte byte) {
    return static_cast<std::uint8_t>(byte);
  });
}

/// What stands between a record's format and its payload. Past the end of the bytes all is 0.
struct Head {
  Record record;
  std::uint32_t payload_length = 0;
};

/// Format 1 names its whole keyspace.
Result<Head> read_head_1(detail::ByteReader& in) {
  Head head;
  const auto key_length = in.take<std::uint16_t>();
  SEMVIEW_TRY(const Keyspace keyspace, keyspace_from_bytes(in.take_bytes(key_length)));
  head.record.key.keyspace = digest(keyspace);
  head.record.key.cell.ix = in.take<std::int32_t>();
  head.record.key.cell.iy = in.take<std::int32_t>();
  head.record.codec = in.take<std::uint8_t>();
  head.payload_length = in.take<std::uint32_t>();
  return head;
}

Result<Head> read_head_2(detail::ByteReader& in) {
  Head head;
  take_digest(in, head.record.key.keyspace);
  head.record.key.cell.iy = take_big_endian(in);
  head.record.key.cell.ix = take_big_endian(in);
  head.record.codec = in.take<std::uint8_t>();
  head.payload_length = in.take_varint();
  return head;
}

}  // namespace

RecordKey record_key(const ViewKey& key) {
  RecordKey bytes{};
  const auto name = std::as_bytes(std::span(key.keyspace.bytes));
  std::byte* out = std::ranges::copy(name, bytes.data()).out;
  add_big_endian(out, key.cell.iy);
  add_big_endian(out, key.cell.ix);
  return bytes;
}

std::vector<std::byte> encode_record(const ViewKey& key,
                                     std::uint8_t codec,
                                     std::span<const std::byte> payload) {
  detail::ByteWriter out;
  out.reserve(payload.size() + 44);
  out.add_bytes(kRecordMagic);
  out.add(kRecordFormat);
  out.add_bytes(record_key(key));
  out.add(codec);
  out.add_varint(static_cast<std::uint32_t>(payload.size()));
  out.add_bytes(payload);
  out.add(hash64(out.bytes()));
  return std::move(out).take();
}

Result<Record> decode_record(std::span<const std::byte> bytes) {
  detail::ByteReader in(bytes);
  if (!std::ranges::equal(in.take_bytes(kRecordMagic.size()), kRecordMagic)) {
    return fail(ErrorCode::kDataLoss, "record: wrong magic");
  }
  const auto format = in.take<std::uint16_t>();
  if (!in.failed() && format != kRecordFormat && format != 1) {
    return fail(
        ErrorCode::kUnimplemented,
        fmt::format("record: format {}, this program knows 1 and {}", format, kRecordFormat));
  }
  if (in.left() < kChecksumBytes) return fail(ErrorCode::kDataLoss, "record: too short");
  const auto [checked, checksum] =
      std::pair(bytes.first(bytes.size() - kChecksumBytes), bytes.last(kChecksumBytes));
  if (detail::ByteReader(checksum).take<std::uint64_t>() != hash64(checked)) {
    return fail(ErrorCode::kDataLoss, "record: wrong checksum");
  }
  SEMVIEW_TRY(Head head, format == 1 ? read_head_1(in) : read_head_2(in));
  if (in.failed() || in.left() != head.payload_length + kChecksumBytes) {
    return fail(ErrorCode::kDataLoss, "record: wrong payload length");
  }
  head.record.payload = in.take_bytes(head.payload_length);
  return head.record;
}

std::size_t record_length(std::span<const std::byte> bytes) {
  detail::ByteReader in(bytes);
  in.take_bytes(kRecordMagic.size());
  const auto format = in.take<std::uint16_t>();
  std::size_t payload_length = 0;
  if (format == 1) {
    in.take_bytes(in.take<std::uint16_t>());
    in.take_bytes(2 * sizeof(std::int32_t) + sizeof(std::uint8_t));
    payload_length = in.take<std::uint32_t>();
  } else {
    in.take_bytes(sizeof(RecordKey) + sizeof(std::uint8_t));
    payload_length = in.take_varint();
  }
  return in.failed() ? 0 : bytes.size() - in.left() + payload_length + kChecksumBytes;
}

}  // namespace semview::cache
