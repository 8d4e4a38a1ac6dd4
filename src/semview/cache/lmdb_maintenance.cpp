// SPDX-License-Identifier: Apache-2.0
// The parts of LmdbStore that look at a directory as a whole.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "semview/cache/lmdb_repair.hpp"
#include "semview/cache/lmdb_state.hpp"
#include "semview/view/view_codec.hpp"

namespace semview::cache {
namespace {

using detail::Cursor;
using detail::RecordState;
using detail::Transaction;

/// Calls `visit(key, value)` for every entry of a table, in order of the keys.
template <typename Visit>
Status for_each(const detail::Environment& environment, MDB_dbi table, Visit&& visit) {
  SEMVIEW_TRY(const Transaction transaction, Transaction::begin(environment.get(), MDB_RDONLY));
  SEMVIEW_TRY(Cursor cursor, Cursor::open(transaction, table));
  MDB_val key{};
  MDB_val value{};
  int code = cursor.move(key, value, MDB_FIRST);
  for (; code == 0; code = cursor.move(key, value, MDB_NEXT)) {
    SEMVIEW_TRY_STATUS(visit(detail::bytes_of(key), detail::bytes_of(value)));
  }
  if (code != MDB_NOTFOUND) return fail(detail::lmdb_error(code, "read the records"));
  return {};
}

using Descriptions = std::map<Fingerprint, KeyspaceEntry>;

/// The sound descriptions of a directory, by the digests of their keyspaces.
Result<Descriptions> read_descriptions(const detail::Environment& environment) {
  Descriptions descriptions;
  SEMVIEW_TRY_STATUS(
      for_each(environment, environment.keyspaces(), [&](auto, auto value) -> Status {
        if (Result<KeyspaceEntry> entry = detail::read_description(value)) {
          descriptions.emplace(entry->name, *std::move(entry));
        }
        return {};
      }));
  return descriptions;
}

/// `inspect`, and the payload decoded too.
RecordState judge(const Descriptions& descriptions,
                  std::span<const std::byte> key,
                  std::span<const std::byte> bytes) {
  std::optional<Record> record;
  const RecordState state = detail::inspect(key, bytes, record);
  if (state != RecordState::kSound) return state;
  const auto found = descriptions.find(record->key.keyspace);
  const std::optional<ViewShape> shape = found != descriptions.end()
                                             ? shape_of(found->second.keyspace.profile)
                                             : claimed_shape(record->codec, record->payload);
  // Without description and claim there is only the checksum, which was right.
  if (!shape && record->codec != kViewCodec) return state;
  return shape && decode_view(record->codec, record->payload, *shape) ? RecordState::kSound
                                                                      : RecordState::kDamaged;
}

void count(LmdbStore::VerifyReport& report, RecordState state) {
  ++report.records;
  switch (state) {
    case RecordState::kSound:
      ++report.sound;
      break;
    case RecordState::kDamaged:
      ++report.damaged;
      break;
    case RecordState::kForeign:
      ++report.foreign;
      break;
    case RecordState::kUnknown:
      ++report.unknown;
      break;
  }
}

Status rewrite(const detail::Environment& source,
               detail::Environment& target,
               LmdbStore::VerifyReport& report) {
  detail::BatchWriter writer(target, MDB_APPEND);
  SEMVIEW_TRY(const Descriptions descriptions, read_descriptions(source));
  SEMVIEW_TRY_STATUS(for_each(source, source.records(), [&](auto key, auto value) -> Status {
    const RecordState state = judge(descriptions, key, value);
    count(report, state);
    if (state != RecordState::kSound) return {};
    return writer.add(target.records(), key, value);
  }));
  SEMVIEW_TRY_STATUS(writer.commit());
  SEMVIEW_TRY_STATUS(for_each(source, source.keyspaces(), [&](auto key, auto value) -> Status {
    if (!detail::read_description(value)) return {};
    return writer.add(target.keyspaces(), key, value);
  }));
  return writer.sync();
}

}  // namespace

Status LmdbStore::for_each_record(
    const std::function<void(std::span<const std::byte> key, std::span<const std::byte> record)>&
        visit) const {
  const detail::Environment& environment = state_->environment;
  return for_each(environment, environment.records(), [&](auto key, auto value) -> Status {
    visit(key, value);
    return {};
  });
}

Result<LmdbStore::VerifyReport> LmdbStore::verify() const {
  VerifyReport report;
  SEMVIEW_TRY(const Descriptions descriptions, read_descriptions(state_->environment));
  SEMVIEW_TRY_STATUS(
      for_each_record([&](std::span<const std::byte> key, std::span<const std::byte> record) {
        count(report, judge(descriptions, key, record));
      }));
  return report;
}

Result<std::vector<KeyspaceEntry>> LmdbStore::keyspaces() const {
  const detail::Environment& environment = state_->environment;
  SEMVIEW_TRY(Descriptions entries, read_descriptions(environment));
  SEMVIEW_TRY_STATUS(
      for_each(environment, environment.records(), [&](auto key, auto value) -> Status {
        std::optional<Record> record;
        if (detail::inspect(key, value, record) != RecordState::kSound) return {};
        KeyspaceEntry& entry = entries[record->key.keyspace];
        entry.name = record->key.keyspace;  // one whose description is lost is still listed
        ++entry.stored;
        if (std::ranges::binary_search(entry.cells, record->key.cell)) ++entry.stored_cells;
        entry.record_bytes += value.size();
        entry.payload_bytes += record->payload.size();
        return {};
      }));
  std::vector<KeyspaceEntry> list;
  list.reserve(entries.size());
  for (auto& [name, entry] : entries) list.push_back(std::move(entry));
  return list;
}

Result<LmdbStore::CompactReport> LmdbStore::compact(const LmdbConfig& config) {
  const std::filesystem::path& directory = config.directory;
  SEMVIEW_TRY(const detail::DirectoryLock lock, detail::DirectoryLock::take(directory));
  if (!lock.alone()) {
    return fail(Error{ErrorCode::kFailedPrecondition,
                      fmt::format("cache {}: another process has it open", directory.string()),
                      {},
                      "stop that process first"});
  }
  CompactReport report;
  SEMVIEW_TRY(report.rescue, detail::mend_data_file(directory, config.map_bytes));
  const std::filesystem::path fresh = directory / detail::kRewritingFolder;
  std::error_code error;
  std::filesystem::remove_all(fresh, error);  // of a compaction that was killed
  Status written;
  {
    SEMVIEW_TRY(const detail::Environment source,
                detail::Environment::open(directory, config.map_bytes));
    SEMVIEW_TRY(detail::Environment target, detail::Environment::open(fresh, config.map_bytes));
    written = rewrite(source, target, report.found);
    report.bytes_before = source.used_bytes();
    report.bytes_after = target.used_bytes();
  }
  if (written) {
    // Atomic: whoever is killed here leaves either the old file or the new one.
    std::filesystem::rename(fresh / "data.mdb", directory / "data.mdb", error);
    if (error) written = fail(detail::lmdb_error(error.value(), "replace the data file"));
  }
  std::filesystem::remove_all(fresh, error);
  if (!written) {
    return with_context(std::move(written), fmt::format("cache {}", directory.string()));
  }
  return report;
}

}  // namespace semview::cache
