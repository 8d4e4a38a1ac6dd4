// SPDX-License-Identifier: Apache-2.0
#include "semview/cache/record.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "semview/cache/bytes.hpp"

namespace semview::cache {
namespace {

constexpr std::size_t kChecksumBytes = 8;

}  // namespace

std::vector<std::byte> encode_record(std::span<const std::byte> keyspace_bytes,
                                     const CellIndex& cell,
                                     std::uint8_t codec,
                                     std::span<const std::byte> payload) {
  detail::ByteWriter out;
  out.reserve(keyspace_bytes.size() + payload.size() + 29);
  out.add_bytes(kRecordMagic);
  out.add(kRecordFormat);
  out.add(static_cast<std::uint16_t>(keyspace_bytes.size()));
  out.add_bytes(keyspace_bytes);
  out.add(cell.ix);
  out.add(cell.iy);
  out.add(codec);
  out.add(static_cast<std::uint32_t>(payload.size()));
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
  if (!in.failed() && format != kRecordFormat) {
    return fail(ErrorCode::kUnimplemented,
                fmt::format("record: format {}, this program knows {}", format, kRecordFormat));
  }
  if (in.left() < kChecksumBytes) return fail(ErrorCode::kDataLoss, "record: too short");
  const auto [checked, checksum] =
      std::pair(bytes.first(bytes.size() - kChecksumBytes), bytes.last(kChecksumBytes));
  if (detail::ByteReader(checksum).take<std::uint64_t>() != hash64(checked)) {
    return fail(ErrorCode::kDataLoss, "record: wrong checksum");
  }
  const auto key_length = in.take<std::uint16_t>();
  Record record;
  SEMVIEW_TRY(record.keyspace, keyspace_from_bytes(in.take_bytes(key_length)));
  record.cell.ix = in.take<std::int32_t>();
  record.cell.iy = in.take<std::int32_t>();
  record.codec = in.take<std::uint8_t>();
  const auto payload_length = in.take<std::uint32_t>();
  if (in.failed() || in.left() != payload_length + kChecksumBytes) {
    return fail(ErrorCode::kDataLoss, "record: wrong payload length");
  }
  record.payload = in.take_bytes(payload_length);
  return record;
}

std::size_t record_length(std::span<const std::byte> bytes) {
  detail::ByteReader in(bytes);
  in.take_bytes(kRecordMagic.size() + sizeof(kRecordFormat));
  in.take_bytes(in.take<std::uint16_t>());
  in.take_bytes(2 * sizeof(std::int32_t) + sizeof(std::uint8_t));
  const auto payload_length = in.take<std::uint32_t>();
  return in.failed() ? 0 : bytes.size() - in.left() + payload_length + kChecksumBytes;
}

}  // namespace semview::cache
