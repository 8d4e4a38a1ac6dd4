// SPDX-License-Identifier: Apache-2.0
// Records as earlier and present programs wrote them: what was stored once must stay readable.
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "semview/cache/lmdb_store.hpp"
#include "semview/cache/record.hpp"
#include "semview/view/view_codec.hpp"
#include "support/cache_samples.hpp"
#include "support/paths.hpp"
#include "support/temporary_folder.hpp"

namespace semview::cache {
namespace {

constexpr const char* kFolder = SEMVIEW_SOURCE_DIR "/tests/golden/cache/";
const ViewKey kKey = {digest(test_keyspace()), {-3, 5}};

std::vector<std::byte> file_bytes(const std::string& name) {
  std::ifstream file(kFolder + name, std::ios::binary);
  EXPECT_TRUE(file.good()) << name;
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// The picture in the records, drawn with digits: a room with a door, a gap and a table.
ColumnView drawn_view() {
  std::ifstream file(std::string(kFolder) + "view.txt");
  LabelImage labels(12, 120);
  for (int r = 0; r < labels.rows(); ++r) {
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(line.size(), 120U);
    for (int c = 0; c < labels.columns(); ++c) {
      labels.at(r, c) = static_cast<ClassId>(line[static_cast<std::size_t>(c)] - '0');
    }
  }
  return ColumnView::from_labels(labels);
}

class GoldenRecordTest : public ::testing::TestWithParam<int> {
 protected:
  std::vector<std::byte> record_ = file_bytes("record_" + std::to_string(GetParam()) + ".bin");
};

TEST_P(GoldenRecordTest, IsRead) {
  const auto record = decode_record(record_);
  ASSERT_TRUE(record.has_value()) << record.error().message;
  EXPECT_EQ(record->key, kKey);
  EXPECT_EQ(record_length(record_), record_.size());
  const auto view = decode_view(record->codec, record->payload, {120, 12, false});
  ASSERT_TRUE(view.has_value()) << view.error().message;
  EXPECT_EQ(*view, drawn_view());
}

TEST_P(GoldenRecordTest, IsServedFromACacheThatHoldsIt) {
  const testing::TemporaryFolder folder;
  const std::vector<CellIndex> cells = {{-3, 5}, {0, 0}};
  const auto store = LmdbStore::open({folder.path()});
  ASSERT_TRUE(store.has_value());
  ASSERT_TRUE((*store)->put_encoded(test_keyspace(), std::vector{EncodedView{cells[0], record_}}));
  const std::vector<SharedView> found = (*store)->get(test_keyspace(), cells);
  ASSERT_NE(found[0], nullptr);
  EXPECT_EQ(*found[0], drawn_view());
  EXPECT_EQ((*store)->missing(test_keyspace(), cells), std::vector<CellIndex>{cells[1]});
  EXPECT_EQ((*store)->verify()->sound, 1U);
}

INSTANTIATE_TEST_SUITE_P(Formats, GoldenRecordTest, ::testing::Values(1, 2));

TEST(GoldenRecordTest, WhatIsWrittenTodayIsFormat2ByteByByte) {
  EXPECT_EQ(LmdbStore::encode(kKey.keyspace, kKey.cell, drawn_view()).record,
            file_bytes("record_2.bin"));
}

}  // namespace
}  // namespace semview::cache
