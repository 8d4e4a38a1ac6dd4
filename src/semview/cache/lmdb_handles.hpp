// SPDX-License-Identifier: Apache-2.0
/// Owners of LMDB's handles and its errors as ours; for the sources of this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <lmdb.h>

#include "semview/cache/cache_key.hpp"
#include "semview/core/result.hpp"

namespace semview::cache::detail {

/// LMDB's return code as an error: `what: reason`.
Error lmdb_error(int code, std::string_view what);

inline MDB_val value_of(std::span<const std::byte> bytes) {
  // LMDB does not write through a value that is only put or looked up.
  return {bytes.size(), const_cast<std::byte*>(bytes.data())};
}
inline std::span<const std::byte> bytes_of(const MDB_val& value) {
  return {static_cast<const std::byte*>(value.mv_data), value.mv_size};
}

/// A transaction, aborted unless committed.
class Transaction {
 public:
  /// `flags`: MDB_RDONLY or 0.
  static Result<Transaction> begin(MDB_env* environment, unsigned flags);
  Transaction(Transaction&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Transaction& operator=(Transaction&&) = delete;
  ~Transaction() {
    if (handle_ != nullptr) mdb_txn_abort(handle_);
  }
  /// LMDB's return code.
  int commit() { return mdb_txn_commit(std::exchange(handle_, nullptr)); }
  MDB_txn* get() const { return handle_; }

 private:
  explicit Transaction(MDB_txn* handle) : handle_(handle) {}
  MDB_txn* handle_;
};

/// A cursor, closed before its transaction ends.
class Cursor {
 public:
  static Result<Cursor> open(const Transaction& transaction, MDB_dbi database);
  Cursor(Cursor&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Cursor& operator=(Cursor&&) = delete;
  ~Cursor() {
    if (handle_ != nullptr) mdb_cursor_close(handle_);
  }
  /// LMDB's return code.
  int move(MDB_val& key, MDB_val& value, MDB_cursor_op op) {
    return mdb_cursor_get(handle_, &key, &value, op);
  }

 private:
  explicit Cursor(MDB_cursor* handle) : handle_(handle) {}
  MDB_cursor* handle_;
};

/// An open environment with its two databases.
class Environment {
 public:
  /// Makes the directory if it is missing, clears readers of processes that are gone.
  static Result<Environment> open(const std::filesystem::path& directory, std::uint64_t map_bytes);
  /// Of a directory that this process may not write to, which nobody writes to meanwhile.
  static Result<Environment> open_read_only(const std::filesystem::path& directory,
                                            std::uint64_t map_bytes);
  Environment(Environment&&) noexcept = default;
  Environment& operator=(Environment&&) noexcept = default;

  MDB_env* get() const { return handle_.get(); }
  MDB_dbi records() const { return records_; }      ///< `record_key` → record
  MDB_dbi keyspaces() const { return keyspaces_; }  ///< digest → description
  /// Bytes of the data file up to the last page in use.
  std::uint64_t used_bytes() const;
  std::uint64_t page_bytes() const;

 private:
  struct Close {
    void operator()(MDB_env* handle) const { mdb_env_close(handle); }
  };
  Environment() = default;
  static Result<Environment> open(const std::filesystem::path& directory,
                                  std::uint64_t map_bytes,
                                  unsigned flags);
  Status open_databases(unsigned flags);

  std::unique_ptr<MDB_env, Close> handle_;
  MDB_dbi records_ = 0;
  MDB_dbi keyspaces_ = 0;
};

/// Fills a new environment, many entries a transaction. After an error nothing more is to be added.
class BatchWriter {
 public:
  /// `put_flags`: MDB_APPEND if keys come in order, so that pages are full, or 0.
  BatchWriter(const Environment& target, unsigned put_flags)
      : target_(target), put_flags_(put_flags) {}
  Status add(MDB_dbi table, std::span<const std::byte> key, std::span<const std::byte> value);
  /// Ends a table, so that `add` may go on with the next.
  Status commit();
  /// Commits, and returns when all is on the disk.
  Status sync();

 private:
  const Environment& target_;
  unsigned put_flags_;
  std::optional<Transaction> transaction_;
  std::size_t pending_ = 0;
};

/// In a cache directory while `LmdbStore::compact` has it; a kill may leave it behind.
inline constexpr const char* kRewritingFolder = "compacting";

/// A claim on a directory, held by the open file and so released even by a kill -9.
class DirectoryLock {
 public:
  /// Exclusive if no other process has the directory, else shared.
  /// @errors kFailedPrecondition: another process compacts it; kPermissionDenied, kUnavailable.
  static Result<DirectoryLock> take(const std::filesystem::path& directory);
  DirectoryLock(DirectoryLock&& other) noexcept
      : file_(std::exchange(other.file_, -1)), alone_(other.alone_) {}
  DirectoryLock& operator=(DirectoryLock&&) = delete;
  ~DirectoryLock();

  /// Whether the claim is exclusive.
  bool alone() const { return alone_; }
  /// Lets other processes in.
  void share();

 private:
  explicit DirectoryLock(int file) : file_(file) {}
  int file_;
  bool alone_ = false;
};

}  // namespace semview::cache::detail
