// SPDX-License-Identifier: Apache-2.0
// The built program, killed and stopped while it precomputes a real floor.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "semview/cache/lmdb_store.hpp"
#include "semview/core/random.hpp"
#include "support/child_process.hpp"
#include "support/eventually.hpp"
#include "support/temporary_folder.hpp"

namespace semview {
namespace {

using semview::testing::ChildProcess;
using semview::testing::eventually;
using Records = std::map<std::vector<std::byte>, std::vector<std::byte>>;

const std::string kMap = std::string(SEMVIEW_SOURCE_DIR) + "/maps/duplex_level1";

class PrecomputeKillTest : public ::testing::Test {
 protected:
  /// `semview precompute` on a duplex level, at a third of the default's pixels, by the engine that
  /// takes long enough to be interrupted.
  std::unique_ptr<ChildProcess> start(const std::string& cache, const std::string& threads) const {
    return std::make_unique<ChildProcess>("semview",
                                          std::vector<std::string>{"precompute",
                                                                   kMap,
                                                                   "--cache",
                                                                   (folder_ / cache).string(),
                                                                   "--threads",
                                                                   threads,
                                                                   "--engine",
                                                                   "embree",
                                                                   "--columns",
                                                                   "240",
                                                                   "--rows",
                                                                   "45"},
                                          folder_ / "last");
  }

  /// The lines of a finished program's standard output.
  static std::vector<nlohmann::json> events(const ChildProcess& program) {
    std::vector<nlohmann::json> events;
    std::istringstream in(program.output());
    for (std::string line; std::getline(in, line);) events.push_back(nlohmann::json::parse(line));
    return events;
  }

  Records records(const std::string& cache) const {
    Records records;
    const auto store = cache::LmdbStore::open({folder_ / cache});
    EXPECT_TRUE(store.has_value());
    const Status read = (*store)->for_each_record([&](auto key, auto record) {
      records[{key.begin(), key.end()}] = {record.begin(), record.end()};
    });
    EXPECT_TRUE(read.has_value());
    return records;
  }

  testing::TemporaryFolder folder_;
};

TEST_F(PrecomputeKillTest, TwentyKillsLeaveTheRecordsOfAnUninterruptedRun) {
  const auto start_time = std::chrono::steady_clock::now();
  ASSERT_EQ(start("whole", "2")->wait(), 0);
  const std::chrono::duration<double> whole_s = std::chrono::steady_clock::now() - start_time;

  Rng rng(20, "kill");
  int kills = 0;
  for (int tries = 0; kills < 20; ++tries) {
    ASSERT_LT(tries, 100);
    const auto program = start("killed", kills % 2 == 0 ? "2" : "1");
    // Any moment will do: what it interrupts is left to chance.
    std::this_thread::sleep_for(
        std::chrono::duration<double>(rng.uniform(0, whole_s.count() / 16)));
    program->signal(SIGKILL);
    if (const int code = program->wait(); code == -SIGKILL) {
      ++kills;
    } else {
      ASSERT_EQ(code, 0) << program->errors();
      // It was done before the blow: start again from nothing.
      std::filesystem::remove_all(folder_ / "killed");
    }
  }
  const auto last = start("killed", "1");
  ASSERT_EQ(last->wait(), 0) << last->errors();
  const nlohmann::json end = events(*last).back();
  EXPECT_EQ(end["event"], "complete");
  EXPECT_GT(end["found"].get<std::size_t>(), 0U) << "the kills left something to go on from";
  EXPECT_EQ(end["found"].get<std::size_t>() + end["cast"].get<std::size_t>(),
            end["cells"].get<std::size_t>());
  const Records whole = records("whole");
  EXPECT_EQ(whole.size(), end["cells"].get<std::size_t>());
  EXPECT_TRUE(whole == records("killed"));
}

TEST_F(PrecomputeKillTest, CtrlCStopsCleanlyAndTheSameCommandGoesOn) {
  const auto program = start("stopped", "2");
  // The second line of progress: something has been stored.
  ASSERT_TRUE(eventually([&program] {
    const std::string text = program->output();
    return std::count(text.begin(), text.end(), '\n') >= 2;
  }));
  program->signal(SIGINT);
  EXPECT_EQ(program->wait(), 1);
  const nlohmann::json stopped = events(*program).back();
  EXPECT_EQ(stopped["event"], "stopped");
  EXPECT_GT(stopped["cast"].get<std::size_t>(), 0U);
  EXPECT_NE(program->errors().find("run the same command again"), std::string::npos);

  const auto again = start("stopped", "2");
  ASSERT_EQ(again->wait(), 0) << again->errors();
  const nlohmann::json end = events(*again).back();
  EXPECT_EQ(end["event"], "complete");
  EXPECT_EQ(end["found"], stopped["cast"]);
  EXPECT_EQ(end["found"].get<std::size_t>() + end["cast"].get<std::size_t>(),
            end["cells"].get<std::size_t>());
}

}  // namespace
}  // namespace semview
