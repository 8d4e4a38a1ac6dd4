// SPDX-License-Identifier: Apache-2.0
#include "semview/cache/lmdb_store.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/cache_samples.hpp"
#include "support/temporary_folder.hpp"

namespace semview::cache {
namespace {

class LmdbStoreTest : public ::testing::Test {
 protected:
  std::shared_ptr<LmdbStore> open() {
    auto store = LmdbStore::open({folder_.path() / "cache"});
    EXPECT_TRUE(store.has_value()) << (store ? "" : store.error().message);
    return store ? *store : nullptr;
  }

  testing::TemporaryFolder folder_;
  const Keyspace keyspace_ = test_keyspace();
  const std::vector<CellIndex> cells_ = test_cells(20);
  const std::vector<SharedView> views_ = test_views(20);
};

TEST_F(LmdbStoreTest, RemembersViewsAfterItIsClosed) {
  open()->put(keyspace_, cells_, views_);
  const std::vector<SharedView> found = open()->get(keyspace_, cells_);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    ASSERT_NE(found[i], nullptr);
    EXPECT_EQ(*found[i], *views_[i]);
  }
}

TEST_F(LmdbStoreTest, AProcessOpensADirectoryOnce) {
  const std::shared_ptr<LmdbStore> store = open();
  EXPECT_EQ(store, open());
  const auto by_another_name = LmdbStore::open({folder_.path() / "." / "cache"});
  ASSERT_TRUE(by_another_name.has_value());
  EXPECT_EQ(store, *by_another_name);
  const auto other_limit = LmdbStore::open({folder_.path() / "cache", 1'000'000});
  ASSERT_FALSE(other_limit.has_value());
  EXPECT_EQ(other_limit.error().code, ErrorCode::kFailedPrecondition);
}

TEST_F(LmdbStoreTest, RecordsLieInTheirCellsOrder) {
  const std::shared_ptr<LmdbStore> store = open();
  store->put(keyspace_, cells_, views_);
  std::vector<std::vector<std::byte>> keys;
  ASSERT_TRUE(
      store->for_each_record([&](auto key, auto) { keys.emplace_back(key.begin(), key.end()); })
          .has_value());
  EXPECT_EQ(keys.size(), cells_.size());
  EXPECT_TRUE(std::ranges::is_sorted(keys));
  // The last eight bytes: iy, then ix, big-endian with the sign bit flipped.
  const std::vector<std::byte> first(keys[0].end() - 8, keys[0].end());
  const std::vector<std::byte> expected = {std::byte{0x7f},
                                           std::byte{0xff},
                                           std::byte{0xff},
                                           std::byte{0xfe},
                                           std::byte{0x7f},
                                           std::byte{0xff},
                                           std::byte{0xff},
                                           std::byte{0xfd}};
  EXPECT_EQ(first, expected);  // cell (-3, -2)
}

TEST_F(LmdbStoreTest, MissingListsWhatIsNotStored) {
  const std::shared_ptr<LmdbStore> store = open();
  store->put(keyspace_, std::span(cells_).first(15), std::span(views_).first(15));
  const std::vector<CellIndex> missing = store->missing(keyspace_, cells_);
  EXPECT_EQ(missing, std::vector<CellIndex>(cells_.begin() + 15, cells_.end()));
}

TEST_F(LmdbStoreTest, KnowsWhoseViewsItHoldsAndWhetherTheyAreAll) {
  const std::shared_ptr<LmdbStore> store = open();
  std::vector<CellIndex> map_cells(cells_.begin(), cells_.end() - 2);
  store->describe(keyspace_, "my_map", map_cells);
  store->put(keyspace_, std::span(cells_).subspan(5), std::span(views_).subspan(5));
  auto entries = store->keyspaces();
  ASSERT_TRUE(entries.has_value());
  ASSERT_EQ(entries->size(), 1U);
  EXPECT_EQ((*entries)[0].keyspace, keyspace_);
  EXPECT_EQ((*entries)[0].map_id, "my_map");
  EXPECT_EQ((*entries)[0].cells, map_cells);
  EXPECT_EQ((*entries)[0].stored, 15U);
  EXPECT_EQ((*entries)[0].stored_cells, 13U);
  EXPECT_FALSE((*entries)[0].complete());
  store->put(keyspace_, std::span(cells_).first(5), std::span(views_).first(5));
  entries = store->keyspaces();
  ASSERT_TRUE(entries.has_value());
  EXPECT_TRUE((*entries)[0].complete());
}

TEST_F(LmdbStoreTest, AnotherProcessReadsAndWritesTheSameDirectory) {
  open()->put(keyspace_, std::span(cells_).first(5), std::span(views_).first(5));
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const auto store = LmdbStore::open({folder_.path() / "cache"});
    bool good = store.has_value();
    if (good) {
      const auto found = (*store)->get(keyspace_, std::span(cells_).first(5));
      good = found[4] != nullptr && *found[4] == *views_[4];
      (*store)->put(keyspace_, std::span(cells_).subspan(5), std::span(views_).subspan(5));
    }
    _exit(good ? 0 : 1);
  }
  // Meanwhile, in this process: equal bytes for the same cells.
  open()->put(keyspace_, cells_, views_);
  int status = 1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(open()->missing(keyspace_, cells_).empty());
  const auto report = open()->verify();
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->sound, cells_.size());
}

TEST_F(LmdbStoreTest, CompactKeepsEveryRecordAndRefusesWhileTheDirectoryIsOpen) {
  std::vector<std::vector<std::byte>> before;
  {
    const std::shared_ptr<LmdbStore> store = open();
    for (std::size_t i = cells_.size(); i-- > 0;) {
      store->put(keyspace_, std::span(cells_).subspan(i, 1), std::span(views_).subspan(i, 1));
    }
    store->describe(keyspace_, "my_map", cells_);
    ASSERT_TRUE(store
                    ->for_each_record([&](auto, auto record) {
                      before.emplace_back(record.begin(), record.end());
                    })
                    .has_value());
    const auto refused = LmdbStore::compact({folder_.path() / "cache"});
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::kFailedPrecondition);
  }
  const auto report = LmdbStore::compact({folder_.path() / "cache"});
  ASSERT_TRUE(report.has_value()) << report.error().message;
  EXPECT_EQ(report->found.sound, cells_.size());
  EXPECT_LE(report->bytes_after, report->bytes_before);
  std::vector<std::vector<std::byte>> after;
  ASSERT_TRUE(open()
                  ->for_each_record(
                      [&](auto, auto record) { after.emplace_back(record.begin(), record.end()); })
                  .has_value());
  EXPECT_EQ(after, before);
  EXPECT_TRUE((*open()->keyspaces())[0].complete());
}

TEST_F(LmdbStoreTest, AnotherProgramsFileIsRefused) {
  std::filesystem::create_directories(folder_.path() / "cache");
  std::ofstream(folder_.path() / "cache" / "data.mdb") << std::string(9000, 'x');
  const auto store = LmdbStore::open({folder_.path() / "cache"});
  ASSERT_FALSE(store.has_value());
  EXPECT_FALSE(store.error().hint.empty());
}

TEST_F(LmdbStoreTest, APlaceThatCannotBeADirectoryIsAnError) {
  std::ofstream(folder_.path() / "cache") << "a file";
  EXPECT_FALSE(LmdbStore::open({folder_.path() / "cache"}).has_value());
}

}  // namespace
}  // namespace semview::cache
