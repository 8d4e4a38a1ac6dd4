// SPDX-License-Identifier: Apache-2.0
/// The built program semview-server as its users meet it.
#include <csignal>
#include <cstdio>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "client/lib/remote_maps.hpp"
#include "client/lib/remote_score_source.hpp"
#include "semview/map/cell_grid.hpp"
#include "server/room.hpp"
#include "support/paths.hpp"

namespace semview::test {
namespace {

/// A child process; its standard output is read line by line, standard error goes to a file.
class Process {
 public:
  Process(std::vector<std::string> arguments, const std::filesystem::path& log) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return;
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      const int file = ::open(log.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644);
      ::dup2(file, STDERR_FILENO);
      ::close(ends[0]);
      ::close(ends[1]);
      std::string program = std::string(SEMVIEW_BINARY_DIR) + "/semview-server";
      std::vector<char*> argv{program.data()};
      for (std::string& argument : arguments) argv.push_back(argument.data());
      argv.push_back(nullptr);
      ::execv(program.c_str(), argv.data());
      ::_exit(127);
    }
    ::close(ends[1]);
    output_ = ::fdopen(ends[0], "r");
  }
  ~Process() {
    if (running_) {
      ::kill(pid_, SIGKILL);
      wait();
    }
    if (output_ != nullptr) std::fclose(output_);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// The next line of standard output without its end; empty at the end.
  std::string line() {
    std::string text;
    for (int c = std::fgetc(output_); c != EOF && c != '\n'; c = std::fgetc(output_)) {
      text.push_back(static_cast<char>(c));
    }
    return text;
  }
  void signal(int number) const { ::kill(pid_, number); }
  /// The exit code, or minus the signal that ended it.
  int wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    running_ = false;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  pid_t pid_ = -1;
  bool running_ = true;
  FILE* output_ = nullptr;
};

class ServerProcessTest : public testing::Test {
 protected:
  ServerProcessTest() : room_(write_room(folder_.path(), "room")) {}

  std::filesystem::path log() const { return folder_.path() / "log"; }
  std::string log_text() const {
    std::stringstream text;
    text << std::ifstream(log()).rdbuf();
    return text.str();
  }

  /// A server that serves, and its endpoint.
  std::unique_ptr<Process> serve(std::vector<std::string> arguments) {
    auto process = std::make_unique<Process>(std::move(arguments), log());
    const std::string line = process->line();
    const std::string prefix = "listening on ";
    EXPECT_TRUE(line.starts_with(prefix)) << line << log_text();
    endpoint_ = line.substr(std::min(line.size(), prefix.size()));
    return process;
  }

  client::Connection connect() const {
    client::ConnectionConfig config;
    config.endpoint = endpoint_;
    config.timeout = std::chrono::seconds(20);
    return *client::Connection::open(config);
  }

  TemporaryFolder folder_;
  std::filesystem::path room_;
  std::string endpoint_;
};

TEST_F(ServerProcessTest, ServesSeveralMapsAndLeavesOnSigterm) {
  for (const int number : {SIGTERM, SIGINT}) {
    const auto server = serve({"--map",
                               room_.string(),
                               "--map",
                               "twin=" + room_.string(),
                               "--bind",
                               "tcp://127.0.0.1:*"});
    client::Connection connection = connect();
    const auto maps = client::list_maps(connection);
    ASSERT_TRUE(maps) << maps.error().message;
    ASSERT_EQ(maps->size(), 2U);
    EXPECT_EQ(maps->at(0).id, "room");
    EXPECT_EQ(maps->at(1).id, "twin");
    server->signal(number);
    EXPECT_EQ(server->wait(), 0);
    EXPECT_EQ(log_text().find("trusted networks"), std::string::npos);
  }
}

TEST_F(ServerProcessTest, ReadsItsConfigurationFile) {
  std::ofstream(folder_.path() / "server.yaml") << "maps:\n"
                                                   "  - {id: first, path: room}\n"
                                                   "  - second=room\n"
                                                   "bind: tcp://127.0.0.1:*\n"
                                                   "cache: cache\n"
                                                   "threads: 1\n"
                                                   "profile: {columns: 240, rows: 20, "
                                                   "elevation_deg: [-30, 30]}\n"
                                                   "limits: {poses: 10}\n";
  const auto server = serve({"--config", (folder_.path() / "server.yaml").string()});
  client::Connection connection = connect();
  const auto map = client::get_map(connection, "second");
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->profile.camera.columns, 240);
  EXPECT_EQ(map->profile.camera.rows, 20);
  EXPECT_TRUE(std::filesystem::is_directory(folder_.path() / "cache"));
}

TEST_F(ServerProcessTest, WarnsOfAnAddressThatOthersReach) {
  const auto server = serve({"--map", room_.string(), "--bind", "tcp://0.0.0.0:*"});
  server->signal(SIGTERM);
  EXPECT_EQ(server->wait(), 0);
  EXPECT_NE(log_text().find("no authentication"), std::string::npos);
}

TEST_F(ServerProcessTest, WrongUseIsToldInOneLineAndExitsWithTwo) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{}, "no map given"},
      {{"--map", room_.string(), "--bind", "127.0.0.1:5"}, "expected tcp://"},
      {{"--map", room_.string(), "--engine", "crystal"}, "engine"},
      {{"--nonsense"}, "nonsense"},
  };
  for (const auto& [arguments, expected] : cases) {
    Process server(arguments, log());
    EXPECT_EQ(server.wait(), 2) << expected;
    EXPECT_NE(log_text().find(expected), std::string::npos) << log_text();
  }
}

TEST_F(ServerProcessTest, WrongFilesAreToldWithTheirPlaceAndExitWithOne) {
  Process missing({"--map", "/nowhere"}, log());
  EXPECT_EQ(missing.wait(), 1);
  EXPECT_NE(log_text().find("/nowhere"), std::string::npos);
  std::ofstream(folder_.path() / "server.yaml") << "bind: tcp://127.0.0.1:*\nlimit: 3\n";
  Process config({"--config", (folder_.path() / "server.yaml").string()}, log());
  EXPECT_EQ(config.wait(), 1);
  EXPECT_NE(log_text().find("server.yaml:2"), std::string::npos) << log_text();
}

TEST_F(ServerProcessTest, PrecomputesAndKeepsWhatItHasCast) {
  const std::vector<std::string> arguments = {"--map",
                                              room_.string(),
                                              "--bind",
                                              "tcp://127.0.0.1:*",
                                              "--cache",
                                              (folder_.path() / "cache").string()};
  std::uint64_t cast = 0;
  for (const bool again : {false, true}) {
    const auto server = serve(arguments);
    client::Connection connection = connect();
    const auto job =
        client::start_precompute(connection, {"room", client::Region{0.5, 0.5, 1.5, 1.5}, {}});
    ASSERT_TRUE(job) << job.error().message;
    Result<protocol::JobProgress> progress = client::job_status(connection, *job);
    while (progress && progress->state != protocol::JobState::kDone &&
           progress->state != protocol::JobState::kFailed) {
      progress = client::job_status(connection, *job);
    }
    ASSERT_TRUE(progress) << progress.error().message;
    EXPECT_EQ(progress->state, protocol::JobState::kDone);
    if (again) {
      EXPECT_EQ(progress->found_cells, cast);
      EXPECT_EQ(progress->cast_cells, 0U);
    } else {
      cast = progress->cast_cells;
      EXPECT_GT(cast, 0U);
    }
    server->signal(SIGTERM);
    EXPECT_EQ(server->wait(), 0);
  }
}

TEST_F(ServerProcessTest, AKilledServerComesBackUnderItsClients) {
  auto server = serve({"--map", room_.string(), "--bind", "tcp://127.0.0.1:*"});
  client::ConnectionConfig config;
  config.endpoint = endpoint_;
  config.timeout = std::chrono::seconds(20);
  auto site = open_site(room_, {}, {});
  const auto source = client::RemoteScoreSource::open(
      config, "room", similarity::WeightMatrix::identity(site->map().classes));
  ASSERT_TRUE(source) << source.error().message;
  ASSERT_TRUE((*source)->set_observation(observation_at(*site, {1.0, 1.0, 0.0})));
  const ScoreRequest request{many_poses(100), HeadingMode::kCompass, false};
  const auto before = (*source)->score(request);
  ASSERT_TRUE(before);
  server->signal(SIGKILL);
  EXPECT_EQ(server->wait(), -SIGKILL);
  server = serve({"--map", room_.string(), "--bind", endpoint_});
  const auto after = (*source)->score(request);
  ASSERT_TRUE(after) << after.error().message;
  EXPECT_EQ(after->sums, before->sums);
}

}  // namespace
}  // namespace semview::test
