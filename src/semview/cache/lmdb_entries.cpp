// SPDX-License-Identifier: Apache-2.0
// Keys and values of the two tables of a cache directory: docs/formats/cache_record.md.
#include <algorithm>

#include "semview/cache/bytes.hpp"
#include "semview/cache/lmdb_state.hpp"
#include "semview/view/view_codec.hpp"

namespace semview::cache::detail {
namespace {

constexpr std::uint16_t kDescriptionFormat = 1;
constexpr std::size_t kMaxDescribedCells = 100'000'000;  // a square kilometre

/// Cells row by row as runs along x.
struct CellRun {
  CellIndex first;
  std::uint32_t length = 0;
};

std::vector<CellRun> runs_of(std::span<const CellIndex> cells) {
  std::vector<CellRun> runs;
  for (const CellIndex& cell : cells) {
    if (!runs.empty()) {
      CellRun& last = runs.back();
      const std::int64_t next = std::int64_t{last.first.ix} + last.length;
      if (last.first.iy == cell.iy && next == cell.ix) {
        ++last.length;
        continue;
      }
    }
    runs.push_back({cell, 1});
  }
  return runs;
}

}  // namespace

RecordState inspect(std::span<const std::byte> key,
                    std::span<const std::byte> bytes,
                    std::optional<Record>& record) {
  Result<Record> decoded = decode_record(bytes);
  if (!decoded) {
    return decoded.error().code == ErrorCode::kUnimplemented ? RecordState::kUnknown
                                                             : RecordState::kDamaged;
  }
  if (!knows_view_codec(decoded->codec)) return RecordState::kUnknown;
  if (!std::ranges::equal(record_key(decoded->key), key)) return RecordState::kForeign;
  record = *std::move(decoded);
  return RecordState::kSound;
}

std::vector<std::byte> describe(const Keyspace& keyspace,
                                const std::string& map_id,
                                std::span<const CellIndex> map_cells) {
  const std::vector<std::byte> key = to_bytes(keyspace);
  const std::string id = map_id.substr(0, 255);
  const std::vector<CellRun> runs = runs_of(map_cells);
  ByteWriter out;
  out.add_bytes(kDescriptionMagic);
  out.add(kDescriptionFormat);
  out.add(static_cast<std::uint16_t>(key.size()));
  out.add_bytes(key);
  out.add(static_cast<std::uint8_t>(id.size()));
  out.add_bytes(std::as_bytes(std::span(id)));
  out.add(static_cast<std::uint32_t>(runs.size()));
  for (const CellRun& run : runs) {
    out.add(run.first.ix);
    out.add(run.first.iy);
    out.add(run.length);
  }
  out.add(hash64(out.bytes()));
  return std::move(out).take();
}

Result<KeyspaceEntry> read_description(std::span<const std::byte> bytes) {
  const auto damaged = fail(ErrorCode::kDataLoss, "description of a map: damaged");
  ByteReader in(bytes);
  const bool magic = std::ranges::equal(in.take_bytes(kDescriptionMagic.size()), kDescriptionMagic);
  if (!magic || in.take<std::uint16_t>() != kDescriptionFormat || in.left() < 8 ||
      ByteReader(bytes.last(8)).take<std::uint64_t>() != hash64(bytes.first(bytes.size() - 8))) {
    return damaged;
  }
  KeyspaceEntry entry;
  entry.described = true;
  const auto key_length = in.take<std::uint16_t>();
  SEMVIEW_TRY(entry.keyspace, keyspace_from_bytes(in.take_bytes(key_length)));
  entry.name = digest(entry.keyspace);
  entry.map_id = in.take_string(in.take<std::uint8_t>());
  const auto runs = in.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < runs; ++i) {
    const auto ix = in.take<std::int32_t>();
    const auto iy = in.take<std::int32_t>();
    const auto length = in.take<std::uint32_t>();
    if (in.failed() || length > kMaxDescribedCells - entry.cells.size()) return damaged;
    for (std::uint32_t k = 0; k < length; ++k) {
      entry.cells.push_back({static_cast<std::int32_t>(ix + static_cast<std::int64_t>(k)), iy});
    }
  }
  if (in.failed()) return damaged;
  return entry;
}

std::size_t description_length(std::span<const std::byte> bytes) {
  constexpr std::size_t kRunBytes = 12;
  constexpr std::size_t kChecksumBytes = 8;
  ByteReader in(bytes);
  in.take_bytes(kDescriptionMagic.size() + sizeof(kDescriptionFormat));
  in.take_bytes(in.take<std::uint16_t>());
  in.take_bytes(in.take<std::uint8_t>());
  const std::size_t runs = in.take<std::uint32_t>();
  return in.failed() ? 0 : bytes.size() - in.left() + runs * kRunBytes + kChecksumBytes;
}

}  // namespace semview::cache::detail
