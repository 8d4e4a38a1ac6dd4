// SPDX-License-Identifier: Apache-2.0
// Damage to the data file itself: a damaged file is set aside, its sound records are kept, and
// nothing crashes or serves a wrong view.
#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "semview/cache/lmdb_store.hpp"
#include "semview/cache/record.hpp"
#include "semview/core/random.hpp"
#include "support/cache_samples.hpp"
#include "support/temporary_folder.hpp"

namespace semview::cache {
namespace {

constexpr std::size_t kPageBytes = 4096;
constexpr std::size_t kViews = 400;

class LmdbDamageTest : public ::testing::Test {
 protected:
  /// A data file with a past: two maps, views replaced and pages freed.
  void SetUp() override {
    for (std::uint64_t past = 1; past <= 3; ++past) {
      const auto store = LmdbStore::open({folder_.path()});
      ASSERT_TRUE(store.has_value()) << store.error().message;
      (*store)->describe(keyspace_, "house", cells_);
      const std::vector<SharedView> old = test_views(kViews, 1000 * past);
      (*store)->put(keyspace_, cells_, past == 3 ? views_ : old);
      (*store)->put(test_keyspace(2), std::span(cells_).first(50), std::span(old).first(50));
    }
    std::ifstream in(data_file(), std::ios::binary);
    sound_.assign(std::istreambuf_iterator<char>(in), {});
    ASSERT_GT(sound_.size(), 40 * kPageBytes);
  }

  std::filesystem::path data_file() const { return folder_.path() / "data.mdb"; }
  bool set_aside() const { return std::filesystem::exists(folder_.path() / "data.mdb.damaged"); }

  void start_with(const std::string& bytes) const {
    for (const char* name : {"data.mdb.damaged", "lock.mdb"}) {
      std::filesystem::remove(folder_.path() / name);
    }
    std::ofstream(data_file(), std::ios::binary) << bytes;
  }

  /// Opens whatever is there and uses it in every way.
  /// @returns how many views were still there.
  std::size_t use() const {
    const auto store = LmdbStore::open({folder_.path()});
    EXPECT_TRUE(store.has_value()) << store.error().message;
    if (!store) return 0;
    const std::vector<SharedView> found = (*store)->get(keyspace_, cells_);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < kViews; ++i) {
      if (found[i] == nullptr) continue;
      // A page of the past may come back; a view that nobody stored may not.
      bool known = *found[i] == *views_[i];
      for (std::uint64_t past = 1; past <= 2 && !known; ++past) {
        known = *found[i] == *testing::shared_random_view(1000 * past + i);
      }
      EXPECT_TRUE(known) << "cell " << i;
      ++kept;
    }
    EXPECT_TRUE((*store)->verify().has_value());
    EXPECT_TRUE((*store)->keyspaces().has_value());
    (*store)->put(keyspace_, cells_, views_);
    const std::vector<SharedView> after = (*store)->get(keyspace_, cells_);
    EXPECT_TRUE(std::ranges::equal(after, views_, [](const SharedView& a, const SharedView& b) {
      return a != nullptr && *a == *b;
    })) << "what is cast again is stored again";
    return kept;
  }

  testing::TemporaryFolder folder_;
  const Keyspace keyspace_ = test_keyspace();
  const std::vector<CellIndex> cells_ = test_cells(kViews);
  const std::vector<SharedView> views_ = test_views(kViews);
  std::string sound_;
};

TEST_F(LmdbDamageTest, ASoundFileWithAPastIsLeftAlone) {
  start_with(sound_);
  EXPECT_EQ(use(), kViews);
  EXPECT_FALSE(set_aside());
  EXPECT_TRUE(LmdbStore::compact({folder_.path()}).has_value());
  EXPECT_EQ(use(), kViews);
  EXPECT_FALSE(set_aside());
}

TEST_F(LmdbDamageTest, AFileOfAProcessKilledWhileItStoresIsLeftAlone) {
  for (int round = 0; round < 10; ++round) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      const auto store = LmdbStore::open({folder_.path()});
      for (std::uint64_t n = 0; store.has_value(); ++n) {
        (*store)->put(keyspace_, cells_, test_views(kViews, 7000 + n));
      }
      _exit(1);
    }
    ::usleep(static_cast<useconds_t>(20'000 + 7'000 * round));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const auto store = LmdbStore::open({folder_.path()});
    ASSERT_TRUE(store.has_value());
    ASSERT_FALSE(set_aside()) << "round " << round;
    EXPECT_EQ((*store)->verify()->sound, kViews + 50);
  }
}

TEST_F(LmdbDamageTest, AFileCutShortKeepsEveryRecordBeforeTheCut) {
  std::vector<std::string> records;
  start_with(sound_);
  {
    const auto store = LmdbStore::open({folder_.path()});
    ASSERT_TRUE((*store)
                    ->for_each_record([&](auto, std::span<const std::byte> record) {
                      records.emplace_back(reinterpret_cast<const char*>(record.data()),
                                           record.size());
                    })
                    .has_value());
  }
  for (const std::size_t pages : {30, 12, 5}) {
    const std::string cut = sound_.substr(0, pages * kPageBytes + 100);
    start_with(cut);
    const auto in_what_is_left = [&](const std::string& record) {
      return cut.find(record) != std::string::npos;
    };
    const auto before = std::ranges::count_if(records, in_what_is_left);
    const auto store = LmdbStore::open({folder_.path()});
    ASSERT_TRUE(store.has_value()) << store.error().message;
    EXPECT_TRUE(set_aside());
    ASSERT_TRUE((*store)->rescue());
    EXPECT_EQ((*store)->rescue()->set_aside, "data.mdb.damaged");
    EXPECT_EQ((*store)->rescue()->views, (*store)->verify()->records);
    std::ptrdiff_t kept = 0;
    ASSERT_TRUE((*store)
                    ->for_each_record([&](auto, std::span<const std::byte> record) {
                      const std::string bytes(reinterpret_cast<const char*>(record.data()),
                                              record.size());
                      if (std::ranges::find(records, bytes) != records.end()) ++kept;
                    })
                    .has_value());
    EXPECT_GE(kept, before * 9 / 10) << "replaced records lie in the file beside their successors";
  }
}

TEST_F(LmdbDamageTest, WhoseViewsTheyAreIsSavedWithThem) {
  std::string bytes = sound_;
  bytes[16] = static_cast<char>(~bytes[16]);  // the magic number of the file's first page
  start_with(bytes);
  const auto store = LmdbStore::open({folder_.path()});
  ASSERT_TRUE(store && (*store)->rescue());
  const auto entries = (*store)->keyspaces();
  ASSERT_TRUE(entries);
  const auto house = std::ranges::find(*entries, keyspace_, &KeyspaceEntry::keyspace);
  ASSERT_NE(house, entries->end());
  EXPECT_EQ(house->map_id, "house");
  EXPECT_EQ(house->cells.size(), kViews);
}

TEST_F(LmdbDamageTest, NoDamageAnywhereCrashesOrServesAWrongView) {
  Rng rng(7, "damage");
  const std::size_t pages = sound_.size() / kPageBytes;
  std::size_t asides = 0;
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE(round);
    std::string bytes = sound_;
    const std::size_t page = rng.below(pages) * kPageBytes;
    switch (round % 6) {
      case 0:  // cut anywhere
        bytes.resize(1 + rng.below(bytes.size() - 1));
        break;
      case 1:  // one bit in the head of a page, where LMDB keeps its pointers
        bytes[page + rng.below(200)] ^= static_cast<char>(1U << rng.below(8));
        break;
      case 2:  // one bit in either description of the file
        bytes[rng.below(2) * kPageBytes + rng.below(152)] ^= static_cast<char>(1U << rng.below(8));
        break;
      case 3:  // a page of noise
        for (std::size_t i = 0; i < kPageBytes; ++i) {
          bytes[page + i] = static_cast<char>(rng.below(256));
        }
        break;
      case 4:  // a page of zeros, as after a crash of the file system
        std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(page), kPageBytes, '\0');
        break;
      default:  // one page in the place of another
        bytes.replace(page, kPageBytes, sound_, rng.below(pages) * kPageBytes, kPageBytes);
    }
    start_with(bytes);
    use();
    asides += set_aside() ? 1 : 0;
    if (HasFailure()) break;
  }
  EXPECT_GT(asides, 20U);
}

TEST_F(LmdbDamageTest, ASecondDamagedFileDoesNotReplaceTheFirst) {
  for (int times = 0; times < 2; ++times) {
    std::ofstream(data_file(), std::ios::binary) << sound_.substr(0, 20 * kPageBytes);
    EXPECT_TRUE(LmdbStore::open({folder_.path()}).has_value());
  }
  EXPECT_TRUE(set_aside());
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "data.mdb.damaged.2"));
}

TEST_F(LmdbDamageTest, ASecondProcessOpensADirectoryInUse) {
  start_with(sound_);
  int ready[2];
  int done[2];
  ASSERT_EQ(pipe(ready) + pipe(done), 0);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  char byte = 'x';
  if (child == 0) {
    close(done[1]);
    const auto store = LmdbStore::open({folder_.path()});
    const bool told = write(ready[1], &byte, 1) == 1;
    const bool ended = read(done[0], &byte, 1) == 0;
    _exit(store.has_value() && told && ended ? 0 : 1);
  }
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_EQ(use(), kViews);
  EXPECT_FALSE(LmdbStore::compact({folder_.path()}).has_value()) << "the other one has it open";
  close(done[1]);
  int status = 1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace semview::cache
