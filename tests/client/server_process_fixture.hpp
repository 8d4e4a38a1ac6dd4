// SPDX-License-Identifier: Apache-2.0
/// The built program semview-server, with a room to serve.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "client/lib/connection.hpp"
#include "server/room.hpp"
#include "support/running_server.hpp"

namespace semview::test {

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

}  // namespace semview::test
