// SPDX-License-Identifier: Apache-2.0
// `semview bench` as people call it: what it measures over TCP agrees, and what it cannot measure
// it says before it begins.
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/child_process.hpp"
#include "support/paths.hpp"
#include "support/temporary_folder.hpp"

namespace semview {
namespace {

using semview::testing::ChildProcess;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Arguments = std::vector<std::string>;

const std::string kMap = SEMVIEW_SOURCE_DIR "/maps/duplex_level1";

class BenchTest : public ::testing::Test {
 protected:
  int run(const Arguments& arguments) {
    ChildProcess process("semview", arguments, folder_ / "streams");
    const int code = process.wait();
    output_ = process.output();
    errors_ = process.errors();
    return code;
  }

  /// Expects wrong usage (exit code 2): `words` in the first line, which says all, and nothing
  /// measured.
  void expect_usage(const Arguments& more, const std::string& words) {
    Arguments arguments{"bench", "load", kMap};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run(arguments), 2) << output_ << errors_;
    const std::string line = errors_.substr(0, errors_.find('\n'));
    EXPECT_THAT(line, HasSubstr(words));
    const std::string rest = errors_.substr(line.size() + 1);
    EXPECT_THAT(rest, AnyOf("", "Run with --help for more information.\n"));
    EXPECT_EQ(output_, "");
  }

  semview::testing::TemporaryFolder folder_;
  std::string output_;
  std::string errors_;
};

TEST_F(BenchTest, RowsOverTcpAgreeWithTheCallsInProcess) {
  ASSERT_EQ(run({"bench",
                 "--quick",
                 "--threads",
                 "1",
                 "--only",
                 "served_cold,served_warm,served_views,served_compass",
                 "--json"}),
            0)
      << errors_;
  EXPECT_THAT(output_,
              AllOf(HasSubstr("2 views equal"),
                    HasSubstr("10 views equal"),
                    HasSubstr("40 sums and headings equal"),
                    Not(HasSubstr("not installed"))));
}

TEST_F(BenchTest, LoadOptionsThatExcludeEachOtherAreNamed) {
  expect_usage({"--search", "--robots", "3"}, "--robots excludes --search");
  expect_usage({"--server", "tcp://127.0.0.1:5560", "--cold"}, "--server excludes --cold");
  expect_usage({"--server", "tcp://127.0.0.1:5560", "--threads", "1"},
               "--threads excludes --server");
  expect_usage({"--cold", "--cache", "views"}, "--cache excludes --cold");
}

TEST_F(BenchTest, LoadOptionsThatAreTheServersChoiceAreRefusedBesideOne) {
  for (const auto& [option, value] : std::vector<std::pair<std::string, std::string>>{
           {"--engine", "embree"}, {"--cache", "views"}, {"--columns", "720"}}) {
    expect_usage({"--server", "tcp://127.0.0.1:5560", option, value},
                 option + ": is the server's own choice");
  }
}

TEST_F(BenchTest, ALoadOutOfBoundsIsRefusedByItsOption) {
  expect_usage({"--load", "local"}, "--load: local not in");
  expect_usage({"--robots", "0"}, "--robots 0: expected 1 to ");
  expect_usage({"--rate", "0"}, "--rate 0: expected above 0 to 100 Hz");
  expect_usage({"--seconds", "-1"}, "--seconds -1: expected above 0 to 600");
  expect_usage({"--seconds", "61", "--search"}, "--seconds 61: expected at most 60 with --search");
  expect_usage({"--seconds", "0.001", "--search"},
               "--seconds 0.001: a robot has no time for a cycle");
  expect_usage({"--server", "tcp://192.0.2.1:5560"},
               "--server tcp://192.0.2.1:5560: a load is for a server on this machine");
}

}  // namespace
}  // namespace semview
