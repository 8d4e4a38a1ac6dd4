// SPDX-License-Identifier: Apache-2.0
#include "semview/cache/lmdb_store.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "semview/cache/lmdb_state.hpp"
#include "semview/core/check.hpp"
#include "semview/core/log.hpp"
#include "semview/view/view_codec.hpp"

namespace semview::cache {
namespace {

using detail::RecordState;
using detail::Transaction;

/// Room that storing these records may take at most: pages split half full, and the path to the
/// root copied for each of the two tables.
std::uint64_t room_for(std::span<const EncodedView> views, std::uint64_t page_bytes) {
  std::uint64_t bytes = 16 * page_bytes;
  for (const EncodedView& view : views) {
    bytes += 2 * (view.record.size() + sizeof(RecordKey) + 16);
  }
  return bytes;
}

/// Records name their keyspace by its digest only; so whatever is stored, the directory must be
/// able to tell what the digest stands for. Leaves a fuller description alone.
/// @returns LMDB's return code.
int name_keyspace(const detail::Environment& environment,
                  const Transaction& transaction,
                  const Fingerprint& name,
                  const Keyspace& keyspace) {
  const auto name_bytes = std::as_bytes(std::span(name.bytes));
  MDB_val key = detail::value_of(name_bytes);
  MDB_val there{};
  const int code = mdb_get(transaction.get(), environment.keyspaces(), &key, &there);
  if (code != MDB_NOTFOUND) return code;
  const std::vector<std::byte> text = detail::describe(keyspace, {}, {});
  MDB_val value = detail::value_of(text);
  return mdb_put(transaction.get(), environment.keyspaces(), &key, &value, 0);
}

}  // namespace

LmdbStore::LmdbStore(std::unique_ptr<State> state) : state_(std::move(state)) {}
LmdbStore::~LmdbStore() = default;

std::vector<SharedView> LmdbStore::get(const Keyspace& keyspace, std::span<const CellIndex> cells) {
  std::vector<SharedView> views(cells.size());
  const Fingerprint name = digest(keyspace);
  const ViewShape shape = shape_of(keyspace.profile);
  Result<Transaction> transaction = Transaction::begin(state_->environment.get(), MDB_RDONLY);
  if (!transaction) {
    state_->misses += cells.size();
    if (!state_->read_failure_logged.exchange(true)) {
      log_warning(fmt::format("cache {}: cannot be read, views are cast again: {}",
                              state_->config.directory.string(),
                              transaction.error().message));
    }
    return views;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const RecordKey key = record_key({name, cells[i]});
    MDB_val key_value = detail::value_of(key);
    MDB_val value{};
    const int code = mdb_get(transaction->get(), state_->environment.records(), &key_value, &value);
    std::optional<Record> record;
    RecordState found = RecordState::kDamaged;
    if (code == 0) found = detail::inspect(key, detail::bytes_of(value), record);
    if (found == RecordState::kSound) {
      if (Result<ColumnView> view = decode_view(record->codec, record->payload, shape)) {
        views[i] = std::make_shared<const ColumnView>(*std::move(view));
        ++state_->hits;
        continue;
      }
      found = RecordState::kDamaged;
    }
    ++state_->misses;
    if (code != MDB_NOTFOUND) state_->count(found);
  }
  return views;
}

std::vector<CellIndex> LmdbStore::missing(const Keyspace& keyspace,
                                          std::span<const CellIndex> cells) {
  const Fingerprint name = digest(keyspace);
  std::vector<CellIndex> missing;
  const Result<Transaction> transaction = Transaction::begin(state_->environment.get(), MDB_RDONLY);
  for (const CellIndex& cell : cells) {
    const RecordKey key = record_key({name, cell});
    MDB_val key_value = detail::value_of(key);
    MDB_val value{};
    std::optional<Record> record;
    if (!transaction ||
        mdb_get(transaction->get(), state_->environment.records(), &key_value, &value) != 0) {
      missing.push_back(cell);
      continue;
    }
    const RecordState found = detail::inspect(key, detail::bytes_of(value), record);
    if (found == RecordState::kSound) continue;
    state_->count(found);
    missing.push_back(cell);
  }
  return missing;
}

EncodedView LmdbStore::encode(const Fingerprint& keyspace,
                              const CellIndex& cell,
                              const ColumnView& view) {
  return {cell, encode_record({keyspace, cell}, kViewCodec, encode_view(view))};
}

void LmdbStore::put(const Keyspace& keyspace,
                    std::span<const CellIndex> cells,
                    std::span<const SharedView> views) {
  SEMVIEW_CHECK(cells.size() == views.size());
  if (!state_->storing) {
    state_->refused += cells.size();
    return;
  }
  const Fingerprint name = digest(keyspace);
  std::vector<EncodedView> encoded;
  encoded.reserve(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    encoded.push_back(encode(name, cells[i], *views[i]));
  }
  // What could not be stored is counted and logged; the caller has its views.
  static_cast<void>(put_encoded(keyspace, encoded));
}

Status LmdbStore::put_encoded(const Keyspace& keyspace, std::span<const EncodedView> views) {
  Status stored = state_->storing ? write(keyspace, views) : Status();
  if (!state_->storing) {
    const std::lock_guard lock(state_->reason_mutex);
    stored = fail(Error{
        ErrorCode::kResourceExhausted,
        fmt::format(
            "cache {}: storing has stopped: {}", state_->config.directory.string(), state_->reason),
        {},
        "make or allow more room (--cache-limit) and run the same command again"});
  }
  if (!stored) {
    state_->refused += views.size();
    return stored;
  }
  state_->stored += views.size();
  return {};
}

Status LmdbStore::write(const Keyspace& keyspace, std::span<const EncodedView> views) {
  const detail::Environment& environment = state_->environment;
  SEMVIEW_TRY(Transaction transaction, begin_write());
  const std::uint64_t limit = state_->config.limit_bytes;
  // Asked inside the transaction: no other process can write now.
  if (limit > 0 && environment.used_bytes() + room_for(views, environment.page_bytes()) > limit) {
    return stop_storing({ErrorCode::kResourceExhausted, fmt::format("limit of {} bytes", limit)});
  }
  const Fingerprint name = digest(keyspace);
  if (const int code = name_keyspace(environment, transaction, name, keyspace); code != 0) {
    return stop_storing(detail::lmdb_error(code, "describe a map"));
  }
  for (const EncodedView& view : views) {
    const RecordKey key = record_key({name, view.cell});
    MDB_val key_value = detail::value_of(key);
    MDB_val value = detail::value_of(view.record);
    int code =
        mdb_put(transaction.get(), environment.records(), &key_value, &value, MDB_NOOVERWRITE);
    // Another process may have stored the same bytes meanwhile; `value` is what is there then.
    if (code == MDB_KEYEXIST && !std::ranges::equal(detail::bytes_of(value), view.record)) {
      value = detail::value_of(view.record);
      code = mdb_put(transaction.get(), environment.records(), &key_value, &value, 0);
    }
    if (code != 0 && code != MDB_KEYEXIST) {
      return stop_storing(detail::lmdb_error(code, "store a view"));
    }
  }
  if (const int code = transaction.commit(); code != 0) {
    return stop_storing(detail::lmdb_error(code, "commit"));
  }
  return {};
}

Result<detail::Transaction> LmdbStore::begin_write() {
  Result<Transaction> transaction = Transaction::begin(state_->environment.get(), 0);
  if (!transaction) return stop_storing(transaction.error());
  return transaction;
}

tl::unexpected<Error> LmdbStore::stop_storing(const Error& error) {
  const std::lock_guard lock(state_->reason_mutex);
  if (state_->storing.exchange(false)) {
    state_->reason = error.message;
    log_warning(fmt::format("cache {}: no more views are stored: {}",
                            state_->config.directory.string(),
                            error.message));
  }
  return fail(ErrorCode::kResourceExhausted, error.message);
}

void LmdbStore::describe(const Keyspace& keyspace,
                         const std::string& map_id,
                         std::span<const CellIndex> map_cells) {
  const Fingerprint name = digest(keyspace);
  const auto name_bytes = std::as_bytes(std::span(name.bytes));
  const std::vector<std::byte> text = detail::describe(keyspace, map_id, map_cells);
  const detail::Environment& environment = state_->environment;
  MDB_val key = detail::value_of(name_bytes);
  MDB_val value{};
  {
    const Result<Transaction> reading = Transaction::begin(environment.get(), MDB_RDONLY);
    if (reading && mdb_get(reading->get(), environment.keyspaces(), &key, &value) == 0 &&
        std::ranges::equal(detail::bytes_of(value), text)) {
      return;
    }
  }
  if (!state_->storing) return;
  Result<Transaction> writing = begin_write();
  if (!writing) return;
  value = detail::value_of(text);
  int code = mdb_put(writing->get(), environment.keyspaces(), &key, &value, 0);
  if (code == 0) code = writing->commit();
  if (code != 0) static_cast<void>(stop_storing(detail::lmdb_error(code, "describe a map")));
}

StoreCounters LmdbStore::counters() const {
  StoreCounters counters;
  counters.hits = state_->hits;
  counters.misses = state_->misses;
  counters.stored = state_->stored;
  counters.refused = state_->refused;
  counters.damaged = state_->damaged;
  counters.foreign = state_->foreign;
  counters.unknown = state_->unknown;
  counters.bytes = file_bytes();
  counters.storing = state_->storing;
  return counters;
}

const std::optional<Rescue>& LmdbStore::rescue() const { return state_->rescue; }

std::uint64_t LmdbStore::file_bytes() const { return state_->environment.used_bytes(); }

}  // namespace semview::cache
