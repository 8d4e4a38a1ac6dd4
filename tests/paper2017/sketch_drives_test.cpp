// SPDX-License-Identifier: Apache-2.0
/// The drives on sketches as a whole, on few worlds: orderings, not values.
#include "experiments/paper2017/sketch_drives.hpp"

#include <algorithm>

#include <gtest/gtest.h>

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

TEST(SketchDrivesTest, ThreadsChangeNoByte) {
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
}

}  // namespace
}  // namespace semview::paper2017
