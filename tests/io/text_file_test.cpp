// SPDX-License-Identifier: Apache-2.0
#include "semview/io/text_file.hpp"

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace semview::io {
namespace {

using semview::testing::TemporaryFolder;

TEST(TextFileTest, BytesComeBackAndReplaceWhatWasThere) {
  const TemporaryFolder folder;
  const std::string bytes("a\0\r\n\xff", 5);
  ASSERT_TRUE(write_text_file(folder / "a", "something longer"));
  ASSERT_TRUE(write_text_file(folder / "a", bytes));
  EXPECT_EQ(*read_text_file(folder / "a", 100), bytes);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.part"));
}

TEST(TextFileTest, LimitsFoldersAndMissingFilesAreErrors) {
  const TemporaryFolder folder;
  folder.write("a", "12345");
  EXPECT_TRUE(read_text_file(folder / "a", 5));
  EXPECT_EQ(read_text_file(folder / "a", 4).error().code, ErrorCode::kOutOfRange);
  EXPECT_EQ(read_text_file(folder / "b", 4).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(read_text_file(folder.path(), 4).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(write_text_file(folder / "no/such", "").error().code, ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace semview::io
