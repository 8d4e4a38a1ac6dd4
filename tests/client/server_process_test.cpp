// SPDX-License-Identifier: Apache-2.0
/// The built program semview-server as its users meet it.
#include <csignal>
#include <fstream>

#include <sys/resource.h>

#include "client/lib/remote_maps.hpp"
#include "client/lib/remote_score_source.hpp"
#include "client/lib/remote_view_source.hpp"
#include "client/lib/typed_call.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/v1/jobs.pb.h"
#include "server/raw_client.hpp"
#include "server/room.hpp"
#include "support/engine_wish.hpp"
#include "support/running_server.hpp"

namespace semview::test {
namespace {

using semview::testing::ChildProcess;
using semview::testing::RunningServer;

class ServerProcessTest : public ::testing::Test {
 protected:
  ServerProcessTest() : room_(write_room(folder_.path(), "room")) {}

  /// A server that serves.
  std::unique_ptr<RunningServer> serve(std::vector<std::string> arguments) {
    auto server = std::make_unique<RunningServer>(std::move(arguments), folder_ / "server");
    endpoint_ = server->endpoint();
    return server;
  }

  /// A server that does not come to serve: its exit code, and what it said in `errors_`.
  int fail_to_serve(std::vector<std::string> arguments) {
    ChildProcess server("semview-server", std::move(arguments), folder_ / "server");
    const int code = server.wait();
    errors_ = server.errors();
    return code;
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
  std::string errors_;
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
    EXPECT_EQ(server->errors().find("trusted networks"), std::string::npos);
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
  EXPECT_NE(server->errors().find("no authentication"), std::string::npos);
}

TEST_F(ServerProcessTest, TakesItsEngineFromTheOptionThenTheFileThenTheEnvironment) {
  const std::string wish = testing::engine_wish();
  ::setenv("SEMVIEW_ENGINE", "embree", 1);
  std::ofstream(folder_ / "server.yaml") << "engine: columns\n";
  const std::string file = (folder_ / "server.yaml").string();
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{}, "embree"},
      {{"--config", file}, "columns"},
      {{"--config", file, "--engine", "embree"}, "embree"},
  };
  for (const auto& [options, engine] : cases) {
    std::vector<std::string> arguments{"--map", room_.string(), "--bind", "tcp://127.0.0.1:*"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const auto server = serve(arguments);
    client::Connection connection = connect();
    const auto map = client::get_map(connection, "room");
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_EQ(map->engine, engine);
    EXPECT_EQ(map->engine_reason, "it was asked for");
    server->signal(SIGTERM);
    EXPECT_EQ(server->wait(), 0);
  }
  ::setenv("SEMVIEW_ENGINE", wish.c_str(), 1);
}

TEST_F(ServerProcessTest, WrongUseIsToldInOneLineAndExitsWithTwo) {
  const std::string room = room_.string();
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{}, "no map given"},
      {{"--map", room, "--bind", "127.0.0.1:5"}, "expected tcp://"},
      {{"--map", room, "--engine", "crystal"}, "engine"},
      {{"--map", "Attic=" + room}, "'Attic' is not an id; expected 1 to 64 of a-z, 0-9, _ and -"},
      {{"--map", "=" + room}, "'' is not an id"},
      {{"--map", "attic="}, "no path"},
      {{"--map", room, "--cache-limit", "-1"}, "--cache-limit -1: expected a number of bytes"},
      {{"--map", room, "--cache-limit", "10GB"}, "--cache-limit 10GB: expected a number of bytes"},
      {{"--map", room, "--memory", "much"}, "--memory much: expected a number of bytes"},
      {{"--map", room, "--events-port", "70000"}, "--events-port"},
      {{"--nonsense"}, "nonsense"},
  };
  for (const auto& [arguments, expected] : cases) {
    EXPECT_EQ(fail_to_serve(arguments), 2) << expected;
    EXPECT_NE(errors_.find(expected), std::string::npos) << errors_;
  }
}

TEST_F(ServerProcessTest, WrongFilesAreToldWithTheirPlaceAndExitWithOne) {
  EXPECT_EQ(fail_to_serve({"--map", "/nowhere", "--bind", "tcp://127.0.0.1:*"}), 1);
  EXPECT_NE(errors_.find("/nowhere"), std::string::npos) << errors_;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"limit: 3", "server.yaml:2"},
      {"cache_limit: 10GB", "server.yaml:2: cache_limit 10GB: expected a number of bytes"},
      {"events_port: 70000", "server.yaml:2: events_port 70000; expected 0 to 65535"},
      {"maps: [Attic=room]", "'Attic' is not an id"},
      {"maps: [{id: Attic, path: room}]", "'Attic' is not an id"},
  };
  for (const auto& [line, expected] : cases) {
    const auto config = folder_.write("server.yaml", "bind: tcp://127.0.0.1:*\n" + line + "\n");
    EXPECT_EQ(fail_to_serve({"--config", config.string()}), 1);
    EXPECT_NE(errors_.find(expected), std::string::npos) << errors_;
  }
}

TEST_F(ServerProcessTest, AnAddressThatIsTakenIsToldBeforeAnyMapIsLoaded) {
  const auto server = serve({"--map", room_.string(), "--bind", "tcp://127.0.0.1:*"});
  EXPECT_EQ(fail_to_serve({"--map", "/nowhere", "--bind", endpoint_}), 1);
  EXPECT_NE(errors_.find("--bind " + endpoint_), std::string::npos) << errors_;
  const std::string taken = endpoint_.substr(endpoint_.rfind(':') + 1);
  EXPECT_EQ(
      fail_to_serve({"--map", "/nowhere", "--bind", "tcp://127.0.0.1:*", "--events-port", taken}),
      1);
  EXPECT_NE(errors_.find("--events-port " + taken), std::string::npos) << errors_;
}

TEST_F(ServerProcessTest, LocalhostIsTheLoopbackAddressAndOfOtherNamesAnAddressIsAsked) {
  const auto server = serve({"--map", room_.string(), "--bind", "tcp://localhost:*"});
  EXPECT_TRUE(endpoint_.starts_with("tcp://127.0.0.1:")) << endpoint_;
  client::Connection connection = connect();
  EXPECT_TRUE(client::list_maps(connection));
  EXPECT_EQ(server->errors().find("no authentication"), std::string::npos) << server->errors();
  for (const char* const elsewhere : {"tcp://no-such-host:*", "tcp://192.0.2.1:*"}) {
    EXPECT_EQ(fail_to_serve({"--map", room_.string(), "--bind", elsewhere}), 1);
    EXPECT_NE(errors_.find("127.0.0.1 lets only this machine in"), std::string::npos) << errors_;
    // Nobody is sent to all interfaces unwarned.
    EXPECT_NE(errors_.find("no authentication"), std::string::npos) << errors_;
  }
}

TEST_F(ServerProcessTest, WhatPeersSendWronglyIsNotWrittenToItsLog) {
  const auto server = serve({"--map", room_.string(), "--bind", "tcp://127.0.0.1:*"});
  v1::RequestHeader header = RawClient::header("Hello");
  header.set_client_name("\xff\xfe");
  RawClient client(endpoint_);
  for (const bool well_formed : {true, false}) {
    std::vector<std::string> frames{header.SerializeAsString(), ""};
    if (!well_formed) frames.emplace_back("one too many");
    client.send_frames(frames);
    const auto reply = client.receive();
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->header.error().code(), v1::ERROR_CODE_DATA_LOSS);
  }
  EXPECT_EQ(server->errors().find("UTF-8"), std::string::npos) << server->errors();
}

TEST_F(ServerProcessTest, ALimitOnFileSizesStopsStoringAndNotTheServer) {
  rlimit own{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &own), 0);
  const rlimit small{64 * 1024, own.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);  // children inherit it
  const auto server = serve({"--map",
                             room_.string(),
                             "--bind",
                             "tcp://127.0.0.1:*",
                             "--cache",
                             (folder_.path() / "cache").string()});
  setrlimit(RLIMIT_FSIZE, &own);
  client::ConnectionConfig config;
  config.endpoint = endpoint_;
  config.timeout = std::chrono::seconds(20);
  const auto source = client::RemoteViewSource::open(config, "room");
  ASSERT_TRUE(source) << source.error().message;
  const auto cells = open_site(room_, {}, default_sites())->cells().free_cells();
  for (int round = 0; round < 2; ++round) {
    const auto views = (*source)->views(cells);
    ASSERT_TRUE(views) << views.error().message;
  }
  client::Connection connection = connect();
  const auto stats =
      client::typed_call<v1::GetStatsReply>(connection, "GetStats", v1::GetStatsRequest());
  ASSERT_TRUE(stats);
  EXPECT_FALSE(stats->disk().storing());
  EXPECT_GT(stats->disk().refused(), 0U);
  server->signal(SIGTERM);
  EXPECT_EQ(server->wait(), 0);
}

TEST_F(ServerProcessTest, TheEventsComeFromThePortThatWasNamed) {
  // A port that was free a moment ago.
  const auto first = serve({"--map", room_.string(), "--bind", "tcp://127.0.0.1:*"});
  const std::string port = endpoint_.substr(endpoint_.rfind(':') + 1);
  first->signal(SIGTERM);
  ASSERT_EQ(first->wait(), 0);
  const auto server =
      serve({"--map", room_.string(), "--bind", "tcp://127.0.0.1:*", "--events-port", port});
  client::Connection connection = connect();
  const auto hello = client::typed_call<v1::HelloReply>(connection, "Hello", v1::HelloRequest());
  ASSERT_TRUE(hello) << hello.error().message;
  EXPECT_EQ(std::to_string(hello->events_port()), port);
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
    EXPECT_TRUE(semview::testing::eventually([&] {
      progress = client::job_status(connection, *job);
      return !progress || progress->state == protocol::JobState::kDone;
    }));
    ASSERT_TRUE(progress) << progress.error().message;
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
  auto site = open_site(room_, {}, default_sites());
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
