// SPDX-License-Identifier: Apache-2.0
/// How semview-server comes to serve: its options, its file, its addresses, and what it says when
/// one of them is wrong.
#include <csignal>
#include <cstdlib>
#include <fstream>

#include "client/lib/remote_maps.hpp"
#include "client/lib/typed_call.hpp"
#include "client/server_process_fixture.hpp"
#include "semview/v1/envelope.pb.h"
#include "support/engine_wish.hpp"

namespace semview::test {
namespace {

class ServerStartTest : public ServerProcessTest {};

TEST_F(ServerStartTest, ReadsItsConfigurationFile) {
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

TEST_F(ServerStartTest, WarnsOfAnAddressThatOthersReach) {
  const auto server = serve({"--map", room_.string(), "--bind", "tcp://0.0.0.0:*"});
  server->signal(SIGTERM);
  EXPECT_EQ(server->wait(), 0);
  EXPECT_NE(server->errors().find("no authentication"), std::string::npos);
}

TEST_F(ServerStartTest, TakesItsEngineFromTheOptionThenTheFileThenTheEnvironment) {
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

TEST_F(ServerStartTest, WrongUseIsToldInOneLineAndExitsWithTwo) {
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
      {{"--map", room, "--threads", "-1"}, "--threads: Value -1 not in range"},
      {{"--nonsense"}, "nonsense"},
  };
  for (const auto& [arguments, expected] : cases) {
    EXPECT_EQ(fail_to_serve(arguments), 2) << expected;
    EXPECT_NE(errors_.find(expected), std::string::npos) << errors_;
  }
}

TEST_F(ServerStartTest, WrongFilesAreToldWithTheirPlaceAndExitWithOne) {
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

TEST_F(ServerStartTest, AnAddressThatIsTakenIsToldBeforeAnyMapIsLoaded) {
  const auto server = serve({"--map", room_.string(), "--bind", "tcp://127.0.0.1:*"});
  EXPECT_EQ(fail_to_serve({"--map", "/nowhere", "--bind", endpoint_}), 1);
  EXPECT_NE(errors_.find("--bind " + endpoint_), std::string::npos) << errors_;
  const std::string taken = endpoint_.substr(endpoint_.rfind(':') + 1);
  EXPECT_EQ(
      fail_to_serve({"--map", "/nowhere", "--bind", "tcp://127.0.0.1:*", "--events-port", taken}),
      1);
  EXPECT_NE(errors_.find("--events-port " + taken), std::string::npos) << errors_;
}

TEST_F(ServerStartTest, LocalhostIsTheLoopbackAddressAndOfOtherNamesAnAddressIsAsked) {
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

TEST_F(ServerStartTest, TheEventsComeFromThePortThatWasNamed) {
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

}  // namespace
}  // namespace semview::test
