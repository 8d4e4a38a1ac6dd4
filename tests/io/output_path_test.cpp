// SPDX-License-Identifier: Apache-2.0
#include "semview/io/output_path.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "semview/io/png.hpp"
#include "semview/io/text_file.hpp"
#include "support/temporary_folder.hpp"

namespace semview::io {
namespace {

using semview::testing::TemporaryFolder;
using ::testing::HasSubstr;

TEST(OutputPathTest, AFileInAFolderThatIsThereCanBeWrittenOrReplaced) {
  const TemporaryFolder folder;
  EXPECT_TRUE(check_output_file(folder / "new.png"));
  EXPECT_TRUE(check_output_file(folder.write("old.png", "old")));
  EXPECT_TRUE(check_output_file("in_the_working_folder.png"));
  EXPECT_TRUE(check_output_file("/dev/null"));
  EXPECT_FALSE(std::filesystem::exists(folder / "new.png")) << "looking makes nothing";
}

TEST(OutputPathTest, AMissingFolderIsNamedWithTheCommandThatMakesIt) {
  const TemporaryFolder folder;
  const Status status = check_output_file(folder / "a/b/new.png");
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message, HasSubstr("a/b/new.png: cannot be written: the folder "));
  EXPECT_EQ(status.error().hint, "make it first: mkdir -p " + (folder / "a/b").string());
}

TEST(OutputPathTest, AFolderIsNoFileAndAFileNoFolder) {
  const TemporaryFolder folder;
  EXPECT_THAT(check_output_file(folder.path()).error().message, HasSubstr("it is a folder"));
  const auto file = folder.write("file", "");
  EXPECT_THAT(check_output_file(file / "new.png").error().message, HasSubstr("is not a folder"));
  EXPECT_THAT(check_output_folder(file / "x").error().message, HasSubstr("is not a folder"));
  EXPECT_THAT(check_output_folder(file).error().message, HasSubstr("is not a folder"));
}

TEST(OutputPathTest, AFolderMayBeMadeWithThoseAboveIt) {
  const TemporaryFolder folder;
  EXPECT_TRUE(check_output_folder(folder.path()));
  EXPECT_TRUE(check_output_folder(folder / "a/b/c"));
  EXPECT_TRUE(check_output_folder("new_in_the_working_folder"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a")) << "looking leaves nothing";
}

TEST(OutputPathTest, AFolderThatNobodyCanMakeIsRefused) {
  const Status status = check_output_folder("/proc/new");
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message, HasSubstr("/proc/new: cannot be written: "));
}

TEST(OutputPathTest, AFolderWithoutTheRightToWriteIsRefused) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read);
  EXPECT_FALSE(check_output_file(folder / "new.png"));
  EXPECT_FALSE(check_output_folder(folder / "new"));
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST(OutputPathTest, APartOfAMapRunLogOrObservationIsNotWrittenOver) {
  const TemporaryFolder folder;
  for (const char* const name : {"odometry.txt", "est.tum", "occupancy.png", "labels.png"}) {
    folder.write(name, "");
  }
  EXPECT_TRUE(check_output_file(folder / "odometry.txt"));  // of no run log
  folder.write("log.yaml", "");
  folder.write("map.yaml", "");
  for (const char* const name : {"odometry.txt", "log.yaml", "map.yaml", "labels.png"}) {
    const Status refused = check_output_file(folder / name);
    ASSERT_FALSE(refused) << name;
    EXPECT_THAT(refused.error().message, HasSubstr("in this folder, and would be written over"));
  }
  EXPECT_TRUE(check_output_file(folder / "groundtruth.txt"));  // there is none
  EXPECT_TRUE(check_output_file(folder / "est.tum"));
  EXPECT_TRUE(check_output_file(folder / "occupancy.png"));  // drawn again from the map
}

TEST(OutputPathTest, AnInputUnderAnyNameIsAnInput) {
  const TemporaryFolder folder;
  const std::string photo = folder.write("a.png", "").string();
  std::filesystem::create_symlink(photo, folder / "b.png");
  const std::vector<std::string> inputs{"not there", photo};
  EXPECT_FALSE(check_is_no_input(folder / "a.png", inputs));
  EXPECT_FALSE(check_is_no_input(folder.path() / "." / "a.png", inputs));
  EXPECT_FALSE(check_is_no_input(folder / "b.png", inputs));
  EXPECT_TRUE(check_is_no_input(folder / "c.png", inputs));
}

TEST(OutputPathTest, AFolderOfSomethingElseIsLeftAlone) {
  const TemporaryFolder folder;
  EXPECT_TRUE(check_holds_nothing_else(folder / "new", FolderKind::kMap));
  EXPECT_TRUE(check_holds_nothing_else(folder.path(), FolderKind::kObservation));
  folder.write("labels.png", "");
  EXPECT_TRUE(check_holds_nothing_else(folder.path(), FolderKind::kRunLog));
  for (const FolderKind kind : {FolderKind::kMap, FolderKind::kObservation}) {
    const Status refused = check_holds_nothing_else(folder.path(), kind);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("labels.png: is there already"));
  }
  folder.write("observation.yaml", "");
  EXPECT_TRUE(check_holds_nothing_else(folder.path(), FolderKind::kObservation));
  for (const FolderKind kind : {FolderKind::kMap, FolderKind::kRunLog}) {
    const Status refused = check_holds_nothing_else(folder.path(), kind);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message,
                HasSubstr("has observation.yaml, expected a new or empty folder for the"));
  }
}

// Linux's full device stands for a full disk.

TEST(OutputPathTest, AFullDiskIsCalledFullAndNothingHalfWrittenStays) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "est.tum.part");
  const Status text = write_text_file(folder / "est.tum", "1 2 3\n");
  ASSERT_FALSE(text);
  EXPECT_THAT(text.error().message, HasSubstr("est.tum: cannot be written: No space left"));
  EXPECT_THAT(text.error().hint, HasSubstr("free some space"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));

  std::filesystem::create_symlink("/dev/full", folder / "a.png");
  for (const int side : {2, 2000}) {
    const Status png = write_png(folder / "a.png", Image<std::uint8_t>(side, side));
    ASSERT_FALSE(png);
    EXPECT_THAT(png.error().message, HasSubstr("a.png: cannot be written: No space left")) << side;
    EXPECT_THAT(png.error().hint, HasSubstr("free some space"));
  }
}

TEST(OutputPathTest, ADeviceIsWrittenToAndNotReplaced) {
  EXPECT_TRUE(write_text_file("/dev/null", "text"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_FALSE(std::filesystem::exists("/dev/null.part"));
}

}  // namespace
}  // namespace semview::io
