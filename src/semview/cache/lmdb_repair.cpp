// SPDX-License-Identifier: Apache-2.0
#include "semview/cache/lmdb_repair.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <span>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include "semview/cache/lmdb_handles.hpp"
#include "semview/cache/lmdb_page_check.hpp"
#include "semview/cache/lmdb_state.hpp"
#include "semview/cache/record.hpp"
#include "semview/core/log.hpp"

namespace semview::cache::detail {
namespace {

/// A file's bytes, to be read only.
class MappedFile {
 public:
  static Result<MappedFile> open(const std::filesystem::path& path) {
    std::error_code error;
    const auto size = static_cast<std::size_t>(std::filesystem::file_size(path, error));
    if (error == std::errc::no_such_file_or_directory) return MappedFile({});
    if (error) return fail(lmdb_error(error.value(), path.string()));
    if (size == 0) return MappedFile({});
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return fail(lmdb_error(errno, path.string()));
    void* bytes = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor, 0);
    const int code = errno;
    ::close(descriptor);
    if (bytes == MAP_FAILED) return fail(lmdb_error(code, path.string()));
    return MappedFile({static_cast<const std::byte*>(bytes), size});
  }
  MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}
  MappedFile& operator=(MappedFile&&) = delete;
  ~MappedFile() {
    if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
  }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  explicit MappedFile(std::span<const std::byte> bytes) : bytes_(bytes) {}
  std::span<const std::byte> bytes_;
};

using TakeRecord =
    std::function<Status(const Record& record, std::span<const std::byte> record_bytes)>;

/// Calls `take` for every sound record in `file`, wherever it lies: a record tells its own length
/// and has a checksum, and LMDB keeps a value in one piece. Pages that LMDB has freed may give a
/// record twice.
Status for_each_sound_record(std::span<const std::byte> file, const TakeRecord& take) {
  while (true) {
    // Not std::ranges::search: clang 14 cannot compile it for a span.
    const auto found =
        std::search(file.begin(), file.end(), kRecordMagic.begin(), kRecordMagic.end());
    if (found == file.end()) return {};
    file = file.subspan(static_cast<std::size_t>(found - file.begin()));
    const std::size_t length = record_length(file);
    const std::span<const std::byte> bytes = file.first(std::min(length, file.size()));
    const Result<Record> record = decode_record(bytes);
    if (record) SEMVIEW_TRY_STATUS(take(*record, bytes));
    file = file.subspan(record ? bytes.size() : kRecordMagic.size());
  }
}

/// Writes the sound records of `file` into a new environment in `directory`.
/// @returns how many there are now.
Result<std::uint64_t> save_records(std::span<const std::byte> file,
                                   const std::filesystem::path& directory,
                                   std::uint64_t map_bytes) {
  SEMVIEW_TRY(const Environment target, Environment::open(directory, map_bytes));
  BatchWriter writer(target, 0);
  SEMVIEW_TRY_STATUS(
      for_each_sound_record(file, [&](const Record& record, std::span<const std::byte> bytes) {
        return writer.add(
            target.records(), record_key(digest(record.keyspace), record.cell), bytes);
      }));
  SEMVIEW_TRY_STATUS(writer.sync());
  SEMVIEW_TRY(const Transaction reading, Transaction::begin(target.get(), MDB_RDONLY));
  MDB_stat statistics{};
  mdb_stat(reading.get(), target.records(), &statistics);
  return std::uint64_t{statistics.ms_entries};
}

std::filesystem::path free_name(const std::filesystem::path& directory) {
  std::filesystem::path name = directory / "data.mdb.damaged";
  std::error_code error;
  for (int n = 2; std::filesystem::exists(name, error); ++n) {
    name = directory / fmt::format("data.mdb.damaged.{}", n);
  }
  return name;
}

}  // namespace

Status mend_data_file(const std::filesystem::path& directory, std::uint64_t map_bytes) {
  const std::filesystem::path data = directory / "data.mdb";
  SEMVIEW_TRY(const MappedFile file, MappedFile::open(data));
  if (file.bytes().empty()) return {};
  const Status pages = check_pages(file.bytes());
  if (pages) return {};
  const std::filesystem::path fresh = directory / "mending";
  std::error_code error;
  std::filesystem::remove_all(fresh, error);  // of a mending that was killed
  const Result<std::uint64_t> saved = save_records(file.bytes(), fresh, map_bytes);
  Status mended;
  const std::filesystem::path aside = free_name(directory);
  if (!saved) {
    mended = fail(Error{ErrorCode::kDataLoss,
                        fmt::format("{}: damaged ({}), and its records cannot be saved: {}",
                                    data.string(),
                                    pages.error().message,
                                    saved.error().message),
                        {},
                        "make room, or remove the file: its views can be cast again"});
  } else if (*saved == 0 && !looks_like_lmdb(file.bytes())) {
    mended = fail(Error{ErrorCode::kFailedPrecondition,
                        fmt::format("{}: not a cache's data file", data.string()),
                        {},
                        "choose another directory, or remove this one if it holds nothing else"});
  } else {
    std::filesystem::rename(data, aside, error);
    if (!error) std::filesystem::rename(fresh / "data.mdb", data, error);
    if (error) mended = fail(lmdb_error(error.value(), fmt::format("{}: replace", data.string())));
  }
  std::filesystem::remove_all(fresh, error);
  if (mended) {
    log_warning(
        fmt::format("cache {}: data.mdb is damaged ({}); {} sound views were saved, the others are "
                    "cast again; the damaged file is now {} and may be removed",
                    directory.string(),
                    pages.error().message,
                    *saved,
                    aside.filename().string()));
  }
  return mended;
}

}  // namespace semview::cache::detail
