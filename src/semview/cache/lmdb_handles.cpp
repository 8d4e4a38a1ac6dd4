// SPDX-License-Identifier: Apache-2.0
#include "semview/cache/lmdb_handles.hpp"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "semview/core/log.hpp"

namespace semview::cache::detail {
namespace {

constexpr unsigned kMaxReaders = 1022;  // threads that read at once, all processes together
constexpr mdb_mode_t kFileMode = 0644;
constexpr std::size_t kEntriesACommit = 20'000;
constexpr auto kLockPoll = std::chrono::milliseconds(20);
/// What LMDB extends its lock file to: a cache line a reader and three for the rest.
constexpr off_t kLockFileBytes = 64 * (kMaxReaders + 2);

ErrorCode code_of(int code) {
  switch (code) {
    case MDB_MAP_FULL:
    case MDB_READERS_FULL:
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return ErrorCode::kResourceExhausted;
    case MDB_CORRUPTED:
    case MDB_PAGE_NOTFOUND:
    case MDB_PANIC:
      return ErrorCode::kDataLoss;
    case MDB_INVALID:
    case MDB_VERSION_MISMATCH:
    case MDB_INCOMPATIBLE:
      return ErrorCode::kFailedPrecondition;
    case EACCES:
    case EPERM:
    case EROFS:
      return ErrorCode::kPermissionDenied;
    default:
      return ErrorCode::kUnavailable;
  }
}

Status make_directory(const std::filesystem::path& directory) {
  std::error_code made;
  std::filesystem::create_directories(directory, made);
  if (!made) return {};
  return fail(
      lmdb_error(made.value(), fmt::format("cache {}: cannot be made", directory.string())));
}

/// LMDB only extends its lock file and then writes to it through a map: on a full disk that is a
/// SIGBUS and no error. So its blocks are claimed first.
///
/// Not while this process has the environment open: closing the file would drop LMDB's own claim.
Status claim_lock_file(const std::filesystem::path& directory) {
  const std::filesystem::path file = directory / "lock.mdb";
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kFileMode);
  if (descriptor < 0) {
    return fail(lmdb_error(errno, fmt::format("cache {}: lock.mdb", directory.string())));
  }
  constexpr off_t kBlockBytes = 512;  // what st_blocks counts, on every file system
  struct stat there {};
  int code = ::fstat(descriptor, &there) == 0 ? 0 : errno;
  // A file that is whole may be in use by others, and is left alone.
  if (code == 0 &&
      (there.st_size < kLockFileBytes || there.st_blocks * kBlockBytes < kLockFileBytes)) {
    code = ::posix_fallocate(descriptor, 0, kLockFileBytes);
  }
  ::close(descriptor);
  if (code == 0) return {};
  Error error = lmdb_error(code, fmt::format("cache {}: lock.mdb", directory.string()));
  error.hint = fmt::format("make room for {} KiB there", kLockFileBytes / 1024);
  return fail(std::move(error));
}

}  // namespace

Error lmdb_error(int code, std::string_view what) {
  return {code_of(code), fmt::format("{}: {}", what, mdb_strerror(code))};
}

Result<Transaction> Transaction::begin(MDB_env* environment, unsigned flags) {
  MDB_txn* handle = nullptr;
  if (const int code = mdb_txn_begin(environment, nullptr, flags, &handle); code != 0) {
    return fail(lmdb_error(code, "begin a transaction"));
  }
  return Transaction(handle);
}

Result<Cursor> Cursor::open(const Transaction& transaction, MDB_dbi database) {
  MDB_cursor* handle = nullptr;
  if (const int code = mdb_cursor_open(transaction.get(), database, &handle); code != 0) {
    return fail(lmdb_error(code, "open a cursor"));
  }
  return Cursor(handle);
}

Result<Environment> Environment::open(const std::filesystem::path& directory,
                                      std::uint64_t map_bytes) {
  SEMVIEW_TRY_STATUS(make_directory(directory));
  SEMVIEW_TRY_STATUS(claim_lock_file(directory));
  // NOMETASYNC: a power cut may lose the last commits, never the file's order; losing views costs
  // only casting them again.
  return open(directory, map_bytes, MDB_NOMETASYNC);
}

Result<Environment> Environment::open_read_only(const std::filesystem::path& directory,
                                                std::uint64_t map_bytes) {
  return open(directory, map_bytes, MDB_RDONLY | MDB_NOLOCK);
}

Result<Environment> Environment::open(const std::filesystem::path& directory,
                                      std::uint64_t map_bytes,
                                      unsigned flags) {
  const auto failed = [&directory](int code, std::string_view what) {
    Error error = lmdb_error(code, fmt::format("cache {}: {}", directory.string(), what));
    if (error.code == ErrorCode::kFailedPrecondition || error.code == ErrorCode::kDataLoss) {
      error.hint = "choose another directory, or remove this one if it holds nothing else";
    }
    return fail(std::move(error));
  };
  MDB_env* handle = nullptr;
  if (const int code = mdb_env_create(&handle); code != 0) return failed(code, "create");
  Environment environment;
  environment.handle_.reset(handle);
  mdb_env_set_mapsize(handle, map_bytes);
  mdb_env_set_maxdbs(handle, 2);
  mdb_env_set_maxreaders(handle, kMaxReaders);
  // NOTLS: readers belong to calls, not threads.
  if (const int code = mdb_env_open(handle, directory.c_str(), MDB_NOTLS | flags, kFileMode);
      code != 0) {
    return failed(code, "open");
  }
  int gone = 0;
  mdb_reader_check(handle, &gone);
  if (Status opened = environment.open_databases(flags & MDB_RDONLY); !opened) {
    return with_context(std::move(opened), fmt::format("cache {}", directory.string()));
  }
  return environment;
}

Status Environment::open_databases(unsigned flags) {
  SEMVIEW_TRY(Transaction transaction, Transaction::begin(get(), flags));
  const unsigned table_flags = flags == MDB_RDONLY ? 0 : MDB_CREATE;
  for (auto [name, database] : {std::pair("records", &records_), {"keyspaces", &keyspaces_}}) {
    if (const int code = mdb_dbi_open(transaction.get(), name, table_flags, database); code != 0) {
      return fail(lmdb_error(code, fmt::format("open table {}", name)));
    }
  }
  if (const int code = transaction.commit(); code != 0) {
    return fail(lmdb_error(code, "write the first pages"));
  }
  return {};
}

std::uint64_t Environment::page_bytes() const {
  MDB_stat statistics{};
  mdb_env_stat(get(), &statistics);
  return statistics.ms_psize;
}

std::uint64_t Environment::used_bytes() const {
  MDB_envinfo information{};
  mdb_env_info(get(), &information);
  return (information.me_last_pgno + 1) * page_bytes();
}

Status BatchWriter::add(MDB_dbi table,
                        std::span<const std::byte> key,
                        std::span<const std::byte> value) {
  if (!transaction_) {
    SEMVIEW_TRY(Transaction begun, Transaction::begin(target_.get(), 0));
    transaction_.emplace(std::move(begun));
  }
  MDB_val key_value = value_of(key);
  MDB_val value_value = value_of(value);
  if (const int code = mdb_put(transaction_->get(), table, &key_value, &value_value, put_flags_);
      code != 0) {
    return fail(lmdb_error(code, "write a new data file"));
  }
  return ++pending_ < kEntriesACommit ? Status() : commit();
}

Status BatchWriter::commit() {
  if (!transaction_) return {};
  const int code = transaction_->commit();
  transaction_.reset();
  pending_ = 0;
  if (code != 0) return fail(lmdb_error(code, "write a new data file"));
  return {};
}

Status BatchWriter::sync() {
  SEMVIEW_TRY_STATUS(commit());
  if (const int code = mdb_env_sync(target_.get(), 1); code != 0) {
    return fail(lmdb_error(code, "write a new data file"));
  }
  return {};
}

Result<DirectoryLock> DirectoryLock::take(const std::filesystem::path& directory) {
  SEMVIEW_TRY_STATUS(make_directory(directory));
  const std::filesystem::path file = directory / "in_use.lock";
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kFileMode);
  if (descriptor < 0) {
    return fail(lmdb_error(errno, fmt::format("cache {}", directory.string())));
  }
  DirectoryLock lock(descriptor);
  lock.alone_ = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  if (lock.alone_) return lock;
  // Another process uses the directory, rewrites it, or is about to be sure of its data file; the
  // last is soon done.
  while (::flock(descriptor, LOCK_SH | LOCK_NB) != 0) {
    std::error_code ignored;
    if (std::filesystem::exists(directory / kRewritingFolder, ignored)) {
      return fail(Error{ErrorCode::kFailedPrecondition,
                        fmt::format("cache {}: is being compacted", directory.string()),
                        {},
                        "try again when that is done"});
    }
    std::this_thread::sleep_for(kLockPoll);
  }
  return lock;
}

void DirectoryLock::share() {
  alone_ = false;
  while (::flock(file_, LOCK_SH) != 0 && errno == EINTR) {
  }
}

DirectoryLock::~DirectoryLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace semview::cache::detail
