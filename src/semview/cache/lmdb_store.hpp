// SPDX-License-Identifier: Apache-2.0
/// Views on disk: one LMDB environment a cache directory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "semview/cache/view_store.hpp"
#include "semview/core/result.hpp"

namespace semview::cache {

namespace detail {
class Transaction;
}

struct LmdbConfig {
  std::filesystem::path directory;
  /// Storing stops when the data file would grow beyond this; 0: as far as map and disk go.
  std::uint64_t limit_bytes = 0;
  /// Address space reserved for the data file, the same in every process that shares the directory;
  /// the file itself is only as large as what it holds.
  std::uint64_t map_bytes = std::uint64_t{64} << 30U;
};

/// What a directory knows about the views of one keyspace.
struct KeyspaceEntry {
  Fingerprint name;  ///< the keyspace's digest
  bool described =
      false;  ///< else the directory has lost whose views these are: only `name` is known
  Keyspace keyspace;
  std::string map_id;               ///< for people; the fingerprint identifies the map
  std::vector<CellIndex> cells;     ///< whose views the whole map needs; empty: not known
  std::uint64_t stored = 0;         ///< sound records there now
  std::uint64_t stored_cells = 0;   ///< those of them that belong to `cells`
  std::uint64_t record_bytes = 0;   ///< of the sound records
  std::uint64_t payload_bytes = 0;  ///< of their views as coded

  bool complete() const { return !cells.empty() && stored_cells == cells.size(); }
};

/// What was done about a damaged data file.
struct Rescue {
  std::uint64_t views = 0;  ///< sound records that went into the new data file
  std::string damage;       ///< the first page that is wrong, and in what
  std::string set_aside;    ///< the damaged file's name now
};

/// A view ready to be stored.
struct EncodedView {
  CellIndex cell;
  std::vector<std::byte> record;
};

/// The disk tier. Records carry their key and a checksum; one that is damaged, foreign or of
/// an unknown version is counted, not served, and replaced by the next `put` of its cell.
///
/// Once the disk, the map or the limit is full, or a write fails, storing stops for the life of
/// this object and reading goes on. Several processes may share a directory; within a process
/// `open` gives the one store that it has for a directory.
class LmdbStore final : public ViewStore {
 public:
  /// Opens or makes the directory. The first process to do so follows the data file's pages; if
  /// they are damaged it sets the file aside as `data.mdb.damaged` and goes on with a new one that
  /// holds every record still sound. A directory that may not be written to is read, and nothing is
  /// stored; nobody else may write to it meanwhile.
  /// @errors kFailedPrecondition: this process has it open with another limit or map size, or it
  /// holds another program's database; kPermissionDenied, kUnavailable: the system refuses;
  /// kDataLoss: the data file is damaged and there is no room for a new one.
  static Result<std::shared_ptr<LmdbStore>> open(const LmdbConfig& config);
  ~LmdbStore() override;

  std::vector<SharedView> get(const Keyspace& keyspace, std::span<const CellIndex> cells) override;
  void put(const Keyspace& keyspace,
           std::span<const CellIndex> cells,
           std::span<const SharedView> views) override;
  StoreCounters counters() const override;

  /// Remembers what `keyspace` belongs to and which views the whole map needs (row by row).
  void describe(const Keyspace& keyspace,
                const std::string& map_id,
                std::span<const CellIndex> map_cells);

  /// The cells that have no sound record, in the order given; reads, checks and counts
  /// every record that is there.
  std::vector<CellIndex> missing(const Keyspace& keyspace, std::span<const CellIndex> cells);

  /// `put` in two steps, so that the first can run on several threads.
  static EncodedView encode(const Fingerprint& keyspace,
                            const CellIndex& cell,
                            const ColumnView& view);
  /// Stores in one transaction, all or nothing.
  /// @errors kResourceExhausted: storing has stopped; the message says why.
  Status put_encoded(const Keyspace& keyspace, std::span<const EncodedView> views);

  /// What opening did, if the data file was damaged.
  const std::optional<Rescue>& rescue() const;

  /// All keyspaces, in order of their digests.
  Result<std::vector<KeyspaceEntry>> keyspaces() const;

  /// Every record's key and bytes in order of the keys, damaged ones too.
  Status for_each_record(const std::function<void(std::span<const std::byte> key,
                                                  std::span<const std::byte> record)>& visit) const;

  struct VerifyReport {
    std::uint64_t records = 0;
    std::uint64_t sound = 0;
    std::uint64_t damaged = 0;
    std::uint64_t foreign = 0;
    std::uint64_t unknown = 0;
  };
  /// Reads and decodes every record.
  Result<VerifyReport> verify() const;

  struct CompactReport {
    std::optional<Rescue> rescue;
    VerifyReport found;
    std::uint64_t bytes_before = 0;
    std::uint64_t bytes_after = 0;
  };
  /// Drops records that are not sound and rewrites the data file with full pages. A kill at any
  /// moment leaves the old file or the new one.
  /// @errors kFailedPrecondition: a process has the directory open, this one included.
  static Result<CompactReport> compact(const LmdbConfig& config);

  /// Bytes of the data file in use.
  std::uint64_t file_bytes() const;

 private:
  struct State;
  explicit LmdbStore(std::unique_ptr<State> state);
  static Result<std::unique_ptr<State>> open_directory(const LmdbConfig& config);
  static Result<std::unique_ptr<State>> open_read_only(const LmdbConfig& config);
  Status write(const Keyspace& keyspace, std::span<const EncodedView> views);
  Result<detail::Transaction> begin_write();
  tl::unexpected<Error> stop_storing(const Error& error);
  std::unique_ptr<State> state_;
};

}  // namespace semview::cache
