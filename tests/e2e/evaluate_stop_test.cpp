// SPDX-License-Identifier: Apache-2.0
// Ctrl-C while an experiment runs: a line says what is kept, and the caller sees the signal.
#include <csignal>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace semview::testing {
namespace {

using ::testing::HasSubstr;

TEST(EvaluateStopTest, SketchesSayWhatIsKeptAndGoOn) {
  const TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  const std::vector<std::string> arguments{"evaluate",
                                           "sketches",
                                           "--worlds",
                                           "1",
                                           "--sketches",
                                           "2",
                                           "--runs",
                                           "1",
                                           "--methods",
                                           "weighted",
                                           "--starts",
                                           "local",
                                           "--threads",
                                           "1",
                                           "-o",
                                           out};
  ChildProcess first("semview", arguments, folder / "first");
  ASSERT_TRUE(first.says("[1/2]", std::chrono::seconds(120))) << first.errors();
  first.signal(SIGINT);
  EXPECT_EQ(first.wait(), -SIGINT);
  EXPECT_THAT(first.errors(), HasSubstr("semview: stopped; "));
  EXPECT_THAT(first.errors(), HasSubstr("go on with --resume"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/units/world_1_sketch_1.csv"));

  std::vector<std::string> resumed = arguments;
  resumed.push_back("--resume");
  ChildProcess second("semview", resumed, folder / "second");
  EXPECT_EQ(second.wait(), 0) << second.errors();
  EXPECT_THAT(second.errors(), HasSubstr("[2/2]"));
  EXPECT_THAT(second.errors(), ::testing::Not(HasSubstr("[1/2]"))) << "it was kept";
  EXPECT_TRUE(std::filesystem::exists(folder / "out/sketches.md"));
}

}  // namespace
}  // namespace semview::testing
