// SPDX-License-Identifier: Apache-2.0
// Full disks and damaged records: storing may stop, serving goes on, nothing wrong is ever served.
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <lmdb.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "semview/cache/lmdb_store.hpp"
#include "semview/cache/memory_tier.hpp"
#include "semview/cache/record.hpp"
#include "semview/cache/view_cache.hpp"
#include "semview/core/random.hpp"
#include "semview/view/view_codec.hpp"
#include "support/cache_samples.hpp"
#include "support/temporary_folder.hpp"

namespace semview::cache {
namespace {

class LmdbFaultTest : public ::testing::Test {
 protected:
  std::filesystem::path data_file() const { return folder_.path() / "data.mdb"; }

  std::string read_file() const {
    std::ifstream in(data_file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write_file(const std::string& bytes) const {
    std::ofstream(data_file(), std::ios::binary) << bytes;
  }

  /// Offers `count` views one by one and expects all of them to be served, whatever was stored.
  StoreCounters fill(const LmdbConfig& config, std::int32_t count) const {
    const auto store = LmdbStore::open(config);
    EXPECT_TRUE(store.has_value());
    ViewCache cache(std::make_shared<MemoryTier>(0), *store);
    std::uint64_t served = 0;
    for (std::int32_t i = 0; i < count; ++i) {
      const std::vector<CellIndex> cell = {{i, 0}};
      const SharedView view = testing::shared_random_view(static_cast<std::uint64_t>(i));
      const auto batch =
          cache.get_or_compute(keyspace_, cell, [&](auto) -> Result<std::vector<SharedView>> {
            return std::vector{view};
          });
      if (batch && batch->views[0] != nullptr && *batch->views[0] == *view) ++served;
    }
    EXPECT_EQ(served, static_cast<std::uint64_t>(count));
    // What was stored before the trouble is still there and right.
    const std::vector<CellIndex> first = {{0, 0}};
    const SharedView found = (*store)->get(keyspace_, first)[0];
    EXPECT_TRUE(found != nullptr && *found == *testing::shared_random_view(0));
    return (*store)->counters();
  }

  testing::TemporaryFolder folder_;
  const Keyspace keyspace_ = test_keyspace();
  const std::vector<CellIndex> cells_ = test_cells(60);
  const std::vector<SharedView> views_ = test_views(60);
};

TEST_F(LmdbFaultTest, AFullMapStopsStoringAndServesOn) {
  const StoreCounters counters = fill({folder_.path(), 0, 128 * 1024}, 400);
  EXPECT_FALSE(counters.storing);
  EXPECT_GT(counters.stored, 0U);
  EXPECT_GT(counters.refused, 0U);
  EXPECT_EQ(counters.stored + counters.refused, 400U);
}

TEST_F(LmdbFaultTest, ALimitStopsStoringBeforeTheFileExceedsIt) {
  constexpr std::uint64_t kLimit = 200 * 1024;
  const StoreCounters counters = fill({folder_.path(), kLimit}, 400);
  EXPECT_FALSE(counters.storing);
  EXPECT_GT(counters.stored, 0U);
  EXPECT_LE(std::filesystem::file_size(data_file()), kLimit);
}

TEST_F(LmdbFaultTest, AStoreThatHasStoppedSaysWhy) {
  const auto store = LmdbStore::open({folder_.path(), 20 * 1024});
  ASSERT_TRUE(store.has_value());
  (*store)->put(keyspace_, cells_, views_);
  const Status refused = (*store)->put_encoded(keyspace_, {});
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::kResourceExhausted);
  EXPECT_NE(refused.error().message.find("limit of 20480 bytes"), std::string::npos);
}

TEST_F(LmdbFaultTest, AFailingWriteStopsStoringAndServesOn) {
  // In a child: the limit on file sizes stands for a full disk and would hold for all that follows.
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{160 * 1024, 160 * 1024};
    setrlimit(RLIMIT_FSIZE, &limit);
    const StoreCounters counters = fill({folder_.path()}, 400);
    _exit(!counters.storing && counters.refused > 0 && !HasFailure() ? 0 : 1);
  }
  int status = 1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  const auto store = LmdbStore::open({folder_.path()});
  ASSERT_TRUE(store.has_value());
  const auto report = (*store)->verify();
  ASSERT_TRUE(report.has_value()) << report.error().message;
  EXPECT_EQ(report->sound, report->records);
}

/// Makes `at` a file system of `kibibytes` for this process alone; false where that is not allowed.
bool mount_small_disk(const std::filesystem::path& at, int kibibytes) {
  if (unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
  const std::string size = "size=" + std::to_string(kibibytes) + "k";
  return mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         mount("tmpfs", at.c_str(), "tmpfs", 0, size.c_str()) == 0;
}

TEST_F(LmdbFaultTest, AFullDiskWithoutALockFileIsAnErrorAndNotASignal) {
  namespace fs = std::filesystem;
  {
    const auto store = LmdbStore::open({folder_.path()});
    ASSERT_TRUE(store.has_value());
    (*store)->put(keyspace_, cells_, views_);
  }
  const fs::path disk = folder_ / "disk";
  fs::create_directory(disk);
  constexpr int kNotAllowed = 77;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    if (!mount_small_disk(disk, 512)) _exit(kNotAllowed);
    fs::copy_file(data_file(), disk / "data.mdb");
    std::ofstream(disk / "in_use.lock").close();
    std::ofstream filler(disk / "filler", std::ios::binary);
    const std::string block(4096, 'x');
    while (filler.write(block.data(), 4096).flush()) {
    }
    const auto store = LmdbStore::open({disk});
    if (store) _exit(2);
    if (store.error().code != ErrorCode::kResourceExhausted) _exit(3);
    if (store.error().message.find("lock.mdb: No space left") == std::string::npos) _exit(4);
    filler.close();
    fs::remove(disk / "filler");
    const auto again = LmdbStore::open({disk});
    if (!again || (*again)->get(keyspace_, cells_)[0] == nullptr) _exit(5);
    _exit(0);
  }
  int status = 1;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  if (WEXITSTATUS(status) == kNotAllowed) GTEST_SKIP() << "mounting is not allowed here";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(LmdbFaultTest, EveryBlockOfTheLockFileIsOnTheDisk) {
  const auto store = LmdbStore::open({folder_.path()});
  ASSERT_TRUE(store.has_value());
  struct stat there {};
  ASSERT_EQ(stat((folder_ / "lock.mdb").c_str(), &there), 0);
  EXPECT_GE(there.st_blocks * 512, there.st_size);
}

TEST_F(LmdbFaultTest, ADirectoryThatCannotBeMadeSaysWhy) {
  std::ofstream(folder_ / "file").close();
  const auto store = LmdbStore::open({folder_ / "file" / "cache"});
  ASSERT_FALSE(store.has_value());
  EXPECT_NE(store.error().message.find("cannot be made: Not a directory"), std::string::npos)
      << store.error().message;
}

TEST_F(LmdbFaultTest, ADirectoryThatMayOnlyBeReadIsReadAndLeftAsItIs) {
  {
    const auto store = LmdbStore::open({folder_.path()});
    ASSERT_TRUE(store.has_value());
    (*store)->put(keyspace_, cells_, views_);
  }
  const std::string before = read_file();
  namespace fs = std::filesystem;
  const fs::perms all_read = fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read;
  for (const auto& entry : fs::directory_iterator(folder_.path())) {
    fs::permissions(entry, all_read);
  }
  fs::permissions(
      folder_.path(),
      all_read | fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec);
  // In a child that is not root, whom no permissions bind.
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    constexpr uid_t kNobody = 65534;
    if (geteuid() == 0 && seteuid(kNobody) != 0) _exit(2);
    const auto store = LmdbStore::open({folder_.path()});
    if (!store) _exit(3);
    (*store)->put(keyspace_, cells_, test_views(60, 500));
    const StoreCounters counters = (*store)->counters();
    if (counters.storing || counters.refused != 60) _exit(4);
    const std::vector<SharedView> found = (*store)->get(keyspace_, cells_);
    for (std::size_t i = 0; i < 60; ++i) {
      if (found[i] == nullptr || *found[i] != *views_[i]) _exit(5);
    }
    _exit(0);
  }
  int status = 1;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  fs::permissions(folder_.path(), fs::perms::owner_all);
  EXPECT_EQ(read_file(), before);
}

TEST_F(LmdbFaultTest, FlippedBytesInRecordsAreSeenCountedAndCastAgain) {
  std::vector<std::vector<std::byte>> records;
  {
    const auto store = LmdbStore::open({folder_.path()});
    ASSERT_TRUE(store.has_value());
    (*store)->put(keyspace_, cells_, views_);
    ASSERT_TRUE((*store)
                    ->for_each_record([&](auto, auto record) {
                      records.emplace_back(record.begin(), record.end());
                    })
                    .has_value());
  }
  std::string file = read_file();
  Rng rng(1, "flips");
  for (std::size_t i = 0; i < 10; ++i) {
    const std::string_view record(reinterpret_cast<const char*>(records[i].data()),
                                  records[i].size());
    // Copies that LMDB has left in free pages are flipped as well.
    const std::uint64_t place = rng.below(record.size());
    for (std::size_t at = file.find(record); at != std::string::npos;
         at = file.find(record, at + 1)) {
      file[at + place] = static_cast<char>(file[at + place] ^ 0x10);
    }
  }
  write_file(file);
  const auto store = LmdbStore::open({folder_.path()});
  ASSERT_TRUE(store.has_value());
  const std::vector<SharedView> found = (*store)->get(keyspace_, cells_);
  std::size_t lost = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (found[i] == nullptr) {
      ++lost;
    } else {
      EXPECT_EQ(*found[i], *views_[i]);
    }
  }
  EXPECT_EQ(lost, 10U);
  const StoreCounters counters = (*store)->counters();
  EXPECT_EQ(counters.damaged + counters.unknown, 10U);
  EXPECT_EQ((*store)->missing(keyspace_, cells_).size(), 10U);

  ViewCache cache(std::make_shared<MemoryTier>(0), *store);
  const auto batch =
      cache.get_or_compute(keyspace_, cells_, [&](std::span<const CellIndex> missing) {
        std::vector<SharedView> made;
        for (const CellIndex& cell : missing) {
          const auto at = std::ranges::find(cells_, cell) - cells_.begin();
          made.push_back(views_[static_cast<std::size_t>(at)]);
        }
        return Result<std::vector<SharedView>>(std::move(made));
      });
  ASSERT_TRUE(batch.has_value());
  EXPECT_EQ(batch->origins, (ViewOrigins{0, 50, 10}));
  EXPECT_TRUE((*store)->missing(keyspace_, cells_).empty()) << "the new records replace the old";
}

/// Writes records past the store, as another program version or a bug might.
class LmdbForeignTest : public LmdbFaultTest {
 protected:
  void put_raw(const CellIndex& key_cell, const std::vector<std::byte>& record) {
    // The key as documented: digest, iy and ix big-endian with the sign bit flipped.
    const Fingerprint name = digest(keyspace_);
    std::string key(reinterpret_cast<const char*>(name.bytes.data()), name.bytes.size());
    for (const std::int32_t value : {key_cell.iy, key_cell.ix}) {
      const std::uint32_t bits = static_cast<std::uint32_t>(value) ^ 0x80000000U;
      for (const unsigned shift : {24U, 16U, 8U, 0U}) key += static_cast<char>(bits >> shift);
    }
    MDB_env* environment = nullptr;
    MDB_txn* transaction = nullptr;
    MDB_dbi table = 0;
    ASSERT_EQ(mdb_env_create(&environment), 0);
    mdb_env_set_maxdbs(environment, 2);
    ASSERT_EQ(mdb_env_open(environment, folder_.path().c_str(), 0, 0644), 0);
    ASSERT_EQ(mdb_txn_begin(environment, nullptr, 0, &transaction), 0);
    ASSERT_EQ(mdb_dbi_open(transaction, "records", MDB_CREATE, &table), 0);
    MDB_val key_value{key.size(), key.data()};
    MDB_val value{record.size(), const_cast<std::byte*>(record.data())};
    ASSERT_EQ(mdb_put(transaction, table, &key_value, &value, 0), 0);
    ASSERT_EQ(mdb_txn_commit(transaction), 0);
    mdb_env_close(environment);
  }
  std::vector<std::byte> record_of(const Keyspace& keyspace,
                                   const CellIndex& cell,
                                   std::uint8_t codec) {
    return encode_record({digest(keyspace), cell}, codec, encode_view(*views_[0]));
  }
};

TEST_F(LmdbForeignTest, RecordsOfAnotherKeyOrVersionAreNeverServed) {
  put_raw({0, 0}, record_of(keyspace_, {0, 0}, kViewCodec));         // sound
  put_raw({1, 0}, record_of(keyspace_, {2, 0}, kViewCodec));         // another cell
  put_raw({2, 0}, record_of(test_keyspace(9), {2, 0}, kViewCodec));  // another map
  put_raw({3, 0}, record_of(keyspace_, {3, 0}, kViewCodec + 1));     // another codec
  std::vector<std::byte> newer = record_of(keyspace_, {4, 0}, kViewCodec);
  newer[4] = std::byte{3};  // format
  put_raw({4, 0}, newer);
  put_raw({5, 0}, {std::byte{1}, std::byte{2}});
  put_raw({6, 0},  // a sound record of a payload that is no view
          encode_record({digest(keyspace_), {6, 0}}, kViewCodec, newer));

  const auto store = LmdbStore::open({folder_.path()});
  ASSERT_TRUE(store.has_value());
  const std::vector<CellIndex> cells = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}, {6, 0}};
  const std::vector<SharedView> found = (*store)->get(keyspace_, cells);
  ASSERT_NE(found[0], nullptr);
  EXPECT_EQ(*found[0], *views_[0]);
  for (std::size_t i = 1; i < cells.size(); ++i) EXPECT_EQ(found[i], nullptr) << i;
  const StoreCounters counters = (*store)->counters();
  EXPECT_EQ(counters.foreign, 2U);
  EXPECT_EQ(counters.unknown, 2U);
  EXPECT_EQ(counters.damaged, 2U);
  const auto report = (*store)->verify();
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->records, 7U);
  EXPECT_EQ(report->sound, 1U);
  EXPECT_EQ(report->foreign, 2U);
  EXPECT_EQ(report->unknown, 2U);
  EXPECT_EQ(report->damaged, 2U);
}

}  // namespace
}  // namespace semview::cache
