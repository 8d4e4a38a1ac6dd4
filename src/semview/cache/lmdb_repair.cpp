// SPDX-License-Identifier: Apache-2.0
#include "semview/cache/lmdb_repair.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
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

/// Calls `take(bytes)` for every place in `file` that starts like one of our values and is as long
/// as `length_of` reads there; `take` says whether the value is sound. Values tell their own length
/// and have a checksum, and LMDB keeps a value in one piece. Pages that LMDB has freed may give one
/// twice.
template <typename LengthOf, typename Take>
Status for_each_sound_value(std::span<const std::byte> file,
                            std::span<const std::byte> magic,
                            LengthOf&& length_of,
                            Take&& take) {
  while (true) {
    // Not std::ranges::search: clang 14 cannot compile it for a span.
    const auto found = std::search(file.begin(), file.end(), magic.begin(), magic.end());
    if (found == file.end()) return {};
    file = file.subspan(static_cast<std::size_t>(found - file.begin()));
    const std::span<const std::byte> bytes = file.first(std::min(length_of(file), file.size()));
    SEMVIEW_TRY(const bool sound, take(bytes));
    file = file.subspan(sound ? bytes.size() : magic.size());
  }
}

/// Writes the sound records and descriptions of `file` into a new environment in `directory`.
/// @returns how many records there are now.
Result<std::uint64_t> save_values(std::span<const std::byte> file,
                                  const std::filesystem::path& directory,
                                  std::uint64_t map_bytes) {
  SEMVIEW_TRY(const Environment target, Environment::open(directory, map_bytes));
  BatchWriter writer(target, 0);
  const auto take_record = [&](std::span<const std::byte> bytes) -> Result<bool> {
    const Result<Record> record = decode_record(bytes);
    if (!record) return false;
    SEMVIEW_TRY_STATUS(writer.add(target.records(), record_key(record->key), bytes));
    return true;
  };
  const auto take_description = [&](std::span<const std::byte> bytes) -> Result<bool> {
    const Result<KeyspaceEntry> entry = read_description(bytes);
    if (!entry) return false;
    const Fingerprint name = digest(entry->keyspace);
    SEMVIEW_TRY_STATUS(writer.add(target.keyspaces(), std::as_bytes(std::span(name.bytes)), bytes));
    return true;
  };
  SEMVIEW_TRY_STATUS(for_each_sound_value(file, kRecordMagic, record_length, take_record));
  SEMVIEW_TRY_STATUS(
      for_each_sound_value(file, kDescriptionMagic, description_length, take_description));
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

Result<std::optional<Rescue>> mend_data_file(const std::filesystem::path& directory,
                                             std::uint64_t map_bytes) {
  const std::filesystem::path data = directory / "data.mdb";
  SEMVIEW_TRY(const MappedFile file, MappedFile::open(data));
  if (file.bytes().empty()) return std::nullopt;
  const Status pages = check_pages(file.bytes());
  if (pages) return std::nullopt;
  const std::filesystem::path fresh = directory / "mending";
  std::error_code error;
  std::filesystem::remove_all(fresh, error);  // of a mending that was killed
  const Result<std::uint64_t> saved = save_values(file.bytes(), fresh, map_bytes);
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
  SEMVIEW_TRY_STATUS(std::move(mended));
  Rescue rescue{*saved, pages.error().message, aside.filename().string()};
  log_warning(
      fmt::format("cache {}: data.mdb is damaged ({}); {} sound views were saved, the others are "
                  "cast again; the damaged file is now {} and may be removed",
                  directory.string(),
                  rescue.damage,
                  rescue.views,
                  rescue.set_aside));
  return rescue;
}

Status check_data_file(const std::filesystem::path& directory) {
  const std::filesystem::path data = directory / "data.mdb";
  SEMVIEW_TRY(const MappedFile file, MappedFile::open(data));
  const Status pages = check_pages(file.bytes());
  if (pages) return {};
  return fail(Error{ErrorCode::kDataLoss,
                    fmt::format("{}: damaged ({})", data.string(), pages.error().message),
                    {},
                    "open it once with the right to write: its sound records are kept"});
}

}  // namespace semview::cache::detail
