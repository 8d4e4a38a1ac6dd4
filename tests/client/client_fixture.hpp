// SPDX-License-Identifier: Apache-2.0
/// A server in this process that can be restarted on its port under the feet of its clients.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "client/lib/connection.hpp"
#include "server.hpp"
#include "server/room.hpp"

namespace semview::test {

class ClientFixture : public ::testing::Test {
 protected:
  void SetUp() override {
    site_ = open_site(write_room(folder_.path(), "room"));
    start();
  }

  void start() {
    server::ServerConfig config;
    config.bind = endpoint_;
    config.workers = 2;
    config.events = false;
    config.epoch = ++epoch_;
    auto started = server::Server::start(config, registry_of({site_}));
    ASSERT_TRUE(started) << started.error().message;
    server_ = *std::move(started);
    endpoint_ = server_->endpoint();
  }
  void stop() { server_.reset(); }

  client::ConnectionConfig config(int timeout_ms = 20'000) const {
    client::ConnectionConfig made;
    made.endpoint = endpoint_;
    made.timeout = std::chrono::milliseconds(timeout_ms);
    made.client_name = "test";
    return made;
  }

  TemporaryFolder folder_;
  std::shared_ptr<service::Site> site_;
  std::string endpoint_ = "tcp://127.0.0.1:*";
  std::uint64_t epoch_ = 0;
  std::unique_ptr<server::Server> server_;
};

}  // namespace semview::test
