// SPDX-License-Identifier: Apache-2.0
// The built program, killed and stopped while it precomputes a real floor.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "semview/cache/lmdb_store.hpp"
#include "semview/core/random.hpp"
#include "support/paths.hpp"
#include "support/temporary_folder.hpp"

namespace semview {
namespace {

using Records = std::map<std::vector<std::byte>, std::vector<std::byte>>;

class PrecomputeKillTest : public ::testing::Test {
 protected:
  /// Starts `semview precompute` on a duplex level, a third of the default's pixels; its output
  /// goes to files in the folder.
  pid_t start(const std::string& cache, const char* threads) const {
    const std::string program = std::string(SEMVIEW_BINARY_DIR) + "/semview";
    const std::string map = std::string(SEMVIEW_SOURCE_DIR) + "/maps/duplex_level1";
    const std::string directory = (folder_.path() / cache).string();
    const std::string out = output().string();
    const std::string err = (folder_.path() / "err").string();
    const pid_t child = fork();
    if (child == 0) {
      dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), STDOUT_FILENO);
      dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), STDERR_FILENO);
      execl(program.c_str(),
            "semview",
            "precompute",
            map.c_str(),
            "--cache",
            directory.c_str(),
            "--threads",
            threads,
            "--columns",
            "240",
            "--rows",
            "45",
            static_cast<char*>(nullptr));
      _exit(127);
    }
    return child;
  }

  static int wait_for(pid_t child) {
    int status = -1;
    waitpid(child, &status, 0);
    return status;
  }

  std::filesystem::path output() const { return folder_.path() / "out"; }

  std::vector<nlohmann::json> events() const {
    std::vector<nlohmann::json> events;
    std::ifstream in(output());
    for (std::string line; std::getline(in, line);) events.push_back(nlohmann::json::parse(line));
    return events;
  }

  Records records(const std::string& cache) const {
    Records records;
    const auto store = cache::LmdbStore::open({folder_.path() / cache});
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
  ASSERT_EQ(wait_for(start("whole", "2")), 0);
  const std::chrono::duration<double> whole_s = std::chrono::steady_clock::now() - start_time;

  Rng rng(20, "kill");
  int kills = 0;
  for (int tries = 0; kills < 20; ++tries) {
    ASSERT_LT(tries, 100);
    const pid_t child = start("killed", kills % 2 == 0 ? "2" : "1");
    std::this_thread::sleep_for(
        std::chrono::duration<double>(rng.uniform(0, whole_s.count() / 16)));
    kill(child, SIGKILL);
    const int status = wait_for(child);
    if (WIFSIGNALED(status)) {
      ASSERT_EQ(WTERMSIG(status), SIGKILL);
      ++kills;
    } else {
      // It was done before the blow: start again from nothing.
      std::filesystem::remove_all(folder_.path() / "killed");
    }
  }
  ASSERT_EQ(wait_for(start("killed", "1")), 0);
  const nlohmann::json end = events().back();
  EXPECT_EQ(end["event"], "complete");
  EXPECT_GT(end["found"].get<std::size_t>(), 0U) << "the kills left something to go on from";
  EXPECT_EQ(end["found"].get<std::size_t>() + end["cast"].get<std::size_t>(),
            end["cells"].get<std::size_t>());
  const Records whole = records("whole");
  EXPECT_EQ(whole.size(), end["cells"].get<std::size_t>());
  EXPECT_TRUE(whole == records("killed"));
}

TEST_F(PrecomputeKillTest, CtrlCStopsCleanlyAndTheSameCommandGoesOn) {
  const pid_t child = start("stopped", "2");
  // The second line of progress: something has been stored.
  for (int i = 0; i < 3000; ++i) {
    std::ifstream in(output());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    if (std::count(text.begin(), text.end(), '\n') >= 2) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  kill(child, SIGINT);
  const int status = wait_for(child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
  const nlohmann::json stopped = events().back();
  EXPECT_EQ(stopped["event"], "stopped");
  EXPECT_GT(stopped["cast"].get<std::size_t>(), 0U);
  EXPECT_NE(testing::file_bytes(folder_.path() / "err").find("run the same command again"),
            std::string::npos);

  ASSERT_EQ(wait_for(start("stopped", "2")), 0);
  const nlohmann::json end = events().back();
  EXPECT_EQ(end["event"], "complete");
  EXPECT_EQ(end["found"], stopped["cast"]);
  EXPECT_EQ(end["found"].get<std::size_t>() + end["cast"].get<std::size_t>(),
            end["cells"].get<std::size_t>());
}

}  // namespace
}  // namespace semview
