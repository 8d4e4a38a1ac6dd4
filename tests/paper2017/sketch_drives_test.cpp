// SPDX-License-Identifier: Apache-2.0
/// The drives on sketches as a whole, on few worlds: orderings, not values.
#include "experiments/paper2017/sketch_drives.hpp"

#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/paper2017/sketch_records.hpp"
#include "experiments/paper2017/sketch_report.hpp"
#include "support/temporary_folder.hpp"

namespace semview::paper2017 {
namespace {

using semview::testing::TemporaryFolder;

double share_of(const std::vector<SketchSummary>& summaries, const std::string& method) {
  const auto found = std::ranges::find(summaries, method, &SketchSummary::method);
  return found == summaries.end() ? -1.0 : found->right_room_share;
}

// That `local` is no better than `none` is a result: README.md of the experiments.
TEST(SketchDrivesTest, OursFindsRoomsAtLeastAsOftenAsThePapersMethodAndOdometry) {
  const TemporaryFolder folder;
  SketchSettings settings;
  settings.worlds = {1, 2, 3};
  settings.sketches = 2;
  settings.runs = 1;
  settings.methods = {"weighted", "none", "local"};
  settings.starts = {Start::kLocal};
  settings.out = folder / "out";
  const auto drives = drive_sketches(settings, [](std::size_t, std::size_t) {});
  ASSERT_TRUE(drives);
  const std::vector<SketchSummary> summaries = summarize(*drives);
  ASSERT_EQ(summaries.size(), 4U);
  for (const char* ours : {"none", "local"}) {
    EXPECT_GE(share_of(summaries, ours), share_of(summaries, "weighted")) << ours;
    EXPECT_GE(share_of(summaries, ours), share_of(summaries, "odometry")) << ours;
    EXPECT_GE(share_of(summaries, ours), 0.9) << ours;
  }
}

TEST(SketchDrivesTest, ThreadsAndResumingChangeNoByte) {
  const TemporaryFolder folder;
  SketchSettings settings;
  settings.worlds = {1};
  settings.sketches = 2;
  settings.runs = 1;
  settings.methods = {"local"};
  settings.starts = {Start::kLocal};
  settings.threads = 1;
  settings.out = folder / "one";
  const auto one = drive_sketches(settings, [](std::size_t, std::size_t) {});
  settings.threads = 2;
  settings.out = folder / "two";
  const auto two = drive_sketches(settings, [](std::size_t, std::size_t) {});
  ASSERT_TRUE(one);
  ASSERT_TRUE(two);
  EXPECT_EQ(to_csv(*one), to_csv(*two));

  ASSERT_TRUE(std::filesystem::remove(settings.out / "units/world_1_sketch_2.csv"));
  settings.resume = true;
  std::size_t calls = 0;
  const auto resumed = drive_sketches(settings, [&](std::size_t done, std::size_t all) {
    ++calls;
    EXPECT_EQ(done, 2U);
    EXPECT_EQ(all, 2U);
  });
  ASSERT_TRUE(resumed);
  EXPECT_EQ(calls, 1U) << "one sketch is done again, the other kept";
  EXPECT_EQ(to_csv(*one), to_csv(*resumed));
}

TEST(SketchDrivesTest, ResultsOfOtherSettingsAreNeitherReplacedNorMixedIn) {
  const TemporaryFolder folder;
  SketchSettings settings;
  settings.worlds = {1};
  settings.sketches = 1;
  settings.runs = 1;
  settings.methods = {"weighted"};
  settings.starts = {Start::kLocal};
  settings.out = folder / "out";
  const auto silent = [](std::size_t, std::size_t) {};
  ASSERT_TRUE(drive_sketches(settings, silent));
  const auto again = drive_sketches(settings, silent);
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().message, ::testing::HasSubstr("holds results already"));
  EXPECT_THAT(again.error().hint, ::testing::HasSubstr("--resume"));
  settings.resume = true;
  settings.seed = 2;
  const auto other = drive_sketches(settings, silent);
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, ::testing::HasSubstr("was made with other settings"));
}

}  // namespace
}  // namespace semview::paper2017
