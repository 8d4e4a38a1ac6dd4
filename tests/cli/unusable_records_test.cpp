// SPDX-License-Identifier: Apache-2.0
// What the verbs say of a cache directory whose records cannot be used.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "semview/cache/lmdb_store.hpp"
#include "semview/cache/record.hpp"
#include "service/small_map.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace semview {
namespace {

constexpr const char* kUnusable = "records could not be used, and their views were cast again";

class UnusableRecordsTest : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// Flips a bit of every record; returns how many there are.
  std::size_t damage_every_record() const {
    const auto store = cache::LmdbStore::open({folder_ / "cache"});
    EXPECT_TRUE(store);
    const cache::Keyspace keyspace = (*store)->keyspaces()->front().keyspace;
    std::vector<cache::EncodedView> damaged;
    EXPECT_TRUE((*store)->for_each_record([&](auto, auto record) {
      const auto sound = cache::decode_record(record);
      damaged.push_back({sound->key.cell, {record.begin(), record.end()}});
      damaged.back().record.back() ^= std::byte{0x10};
    }));
    EXPECT_TRUE((*store)->put_encoded(keyspace, damaged));
    return damaged.size();
  }

  testing::TemporaryFolder folder_;
};

TEST_F(UnusableRecordsTest, PrecomputeCountsThemAtItsEndAndMendsThem) {
  const std::string verb = "precompute '" + testing::write_small_map(folder_).string() +
                           "' --cache '" + file("cache") + "'";
  const auto first = testing::run_semview(verb);
  ASSERT_EQ(first.exit_code, 0) << first.output;
  EXPECT_EQ(first.output.find(kUnusable), std::string::npos) << first.output;
  const std::string count = std::to_string(damage_every_record());
  const auto second = testing::run_semview(verb);
  EXPECT_EQ(second.exit_code, 0);
  EXPECT_NE(second.output.find(count + " " + kUnusable + ": " + count + " damaged"),
            std::string::npos)
      << second.output;
  const auto third = testing::run_semview(verb);
  EXPECT_EQ(third.output.find(kUnusable), std::string::npos) << third.output;
}

TEST_F(UnusableRecordsTest, LocalizeCountsThemAtItsEnd) {
  const std::string map = "'" SEMVIEW_SOURCE_DIR "/maps/duplex_level1'";
  ASSERT_EQ(
      testing::run_semview("simulate " + map + " --steps 2 --seed 1 --out '" + file("log") + "'")
          .exit_code,
      0);
  const std::string verb = "localize --map " + map + " --log '" + file("log") + "' --cache '" +
                           file("cache") + "' --global --particles 50 -o '" + file("est.tum") + "'";
  const auto first = testing::run_semview(verb);
  ASSERT_EQ(first.exit_code, 0) << first.output;
  EXPECT_EQ(first.output.find(kUnusable), std::string::npos) << first.output;
  ASSERT_GT(damage_every_record(), 0U);
  const auto second = testing::run_semview(verb);
  EXPECT_EQ(second.exit_code, 0);
  EXPECT_NE(second.output.find(kUnusable), std::string::npos) << second.output;
}

}  // namespace
}  // namespace semview
