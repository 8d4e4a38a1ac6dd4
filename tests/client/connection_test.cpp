// SPDX-License-Identifier: Apache-2.0
#include "client/lib/connection.hpp"

#include <future>

#include <zmq.hpp>

#include "client/client_fixture.hpp"
#include "client/lib/remote_maps.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/protocol/envelope.hpp"
#include "support/eventually.hpp"

namespace semview::test {
namespace {

using client::Connection;
using client::ConnectionConfig;
using client::Repeat;

TEST(ConnectionConfigTest, WhatCannotBeIsNamed) {
  EXPECT_TRUE(client::validate(ConnectionConfig{}));
  ConnectionConfig config;
  for (const char* const endpoint : {"", "localhost:1", "tcp://", "tcp://host:", "ipc://x:1"}) {
    config.endpoint = endpoint;
    ASSERT_FALSE(client::validate(config)) << endpoint;
    EXPECT_EQ(client::validate(config).error().field, "endpoint");
  }
  config = {};
  config.timeout = std::chrono::milliseconds(0);
  EXPECT_EQ(client::validate(config).error().field, "timeout");
  config = {};
  config.attempts = 0;
  EXPECT_EQ(client::validate(config).error().field, "attempts");
}

TEST(ConnectionConfigTest, NobodyThereIsUnavailableAfterTheTimeout) {
  ConnectionConfig config;
  config.endpoint = "tcp://127.0.0.1:1";
  config.timeout = std::chrono::milliseconds(100);
  auto connection = Connection::open(config);
  ASSERT_TRUE(connection);
  const auto maps = client::list_maps(*connection);
  ASSERT_FALSE(maps);
  EXPECT_EQ(maps.error().code, ErrorCode::kUnavailable);
}

TEST(ConnectionConfigTest, AServerThatIsNotThereIsNotWaitedForAsOneAtWork) {
  ConnectionConfig config;
  config.endpoint = "tcp://127.0.0.1:1";
  config.timeout = std::chrono::hours(1);
  config.contact = std::chrono::milliseconds(100);
  auto connection = Connection::open(config);
  ASSERT_TRUE(connection);
  const auto maps = client::list_maps(*connection);
  ASSERT_FALSE(maps);
  EXPECT_EQ(maps.error().code, ErrorCode::kUnavailable);
  EXPECT_EQ(maps.error().message, "no server at tcp://127.0.0.1:1 within 100 ms");
}

using ConnectionTest = ClientFixture;

TEST_F(ConnectionTest, MapsComeThrough) {
  auto connection = Connection::open(config());
  ASSERT_TRUE(connection);
  const auto maps = client::list_maps(*connection);
  ASSERT_TRUE(maps);
  ASSERT_EQ(maps->size(), 1U);
  EXPECT_EQ(maps->front().id, "room");
  const auto map = client::get_map(*connection, "room");
  ASSERT_TRUE(map);
  EXPECT_EQ(map->classes, site_->map().classes);
  EXPECT_EQ(map->free_cells, site_->cells().free_cells());
  EXPECT_EQ(connection->server_epoch(), epoch_);
}

TEST_F(ConnectionTest, TheServersErrorsComeThrough) {
  auto connection = Connection::open(config());
  const auto map = client::get_map(*connection, "attic");
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(map.error().field, "map_id");
}

TEST_F(ConnectionTest, ARestartedServerIsFoundAgainAndKnownByItsEpoch) {
  auto connection = Connection::open(config());
  ASSERT_TRUE(client::list_maps(*connection));
  stop();
  start();
  ASSERT_TRUE(client::list_maps(*connection));
  EXPECT_EQ(connection->server_epoch(), 2U);
}

TEST_F(ConnectionTest, ACallWaitsForAServerThatComesBackInTime) {
  auto connection = Connection::open(config());
  ASSERT_TRUE(client::list_maps(*connection));
  stop();
  std::promise<void> asking;
  auto answer = std::async(std::launch::async, [&] {
    asking.set_value();
    return client::list_maps(*connection);
  });
  asking.get_future().wait();
  start();
  EXPECT_TRUE(answer.get());
}

TEST_F(ConnectionTest, ALostServerIsUnavailableAndFoundLater) {
  auto connection = Connection::open(config(300));
  ASSERT_TRUE(client::list_maps(*connection));
  stop();
  for (int i = 0; i < 3; ++i) {
    const auto maps = client::list_maps(*connection);
    ASSERT_FALSE(maps);
    EXPECT_EQ(maps.error().code, ErrorCode::kUnavailable);
  }
  start();
  bool found = false;
  for (int i = 0; i < 50 && !found; ++i) found = client::list_maps(*connection).has_value();
  EXPECT_TRUE(found);
}

/// A server made by hand: it answers what the test tells it to.
class ConnectionToFakeTest : public ::testing::Test {
 protected:
  ConnectionToFakeTest() : router_(std::make_unique<zmq::socket_t>(context_, ZMQ_ROUTER)) {
    router_->set(zmq::sockopt::linger, 0);
    router_->set(zmq::sockopt::rcvtimeo, 10'000);
    router_->bind("tcp://127.0.0.1:*");
    config_.endpoint = router_->get(zmq::sockopt::last_endpoint);
    config_.timeout = std::chrono::milliseconds(5000);
  }

  struct Got {
    std::string client;
    v1::RequestHeader header;
  };
  std::optional<Got> receive() {
    zmq::message_t client;
    zmq::message_t header;
    zmq::message_t body;
    if (!router_->recv(client) || !router_->recv(header) || !router_->recv(body)) return {};
    Got got{client.to_string(), {}};
    EXPECT_TRUE(got.header.ParseFromArray(header.data(), static_cast<int>(header.size())));
    return got;
  }
  void reply(const Got& to, std::uint64_t request_id, const Error* error = nullptr) {
    v1::ReplyHeader header;
    header.set_request_id(request_id);
    header.set_protocol_version(1);
    header.set_server_epoch(1);
    if (error != nullptr) *header.mutable_error() = protocol::to_wire(*error);
    router_->send(zmq::buffer(to.client), zmq::send_flags::sndmore);
    router_->send(zmq::buffer(header.SerializeAsString()), zmq::send_flags::sndmore);
    router_->send(zmq::buffer(std::string("body")), zmq::send_flags::none);
  }
  auto ask(Connection& connection, Repeat repeat) {
    return std::async(std::launch::async,
                      [&connection, repeat] { return connection.call("M", "", repeat); });
  }

  zmq::context_t context_;
  std::unique_ptr<zmq::socket_t> router_;
  ConnectionConfig config_;
};

TEST_F(ConnectionToFakeTest, ASlowServerIsNotAskedTwice) {
  config_.timeout = std::chrono::milliseconds(300);
  auto connection = Connection::open(config_);
  auto answer = ask(*connection, Repeat::kSafe);
  ASSERT_TRUE(receive());
  const auto result = answer.get();
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kDeadlineExceeded);
  router_->set(zmq::sockopt::rcvtimeo, 0);
  EXPECT_FALSE(receive());
}

TEST_F(ConnectionToFakeTest, ASignThatTakesLongerThanThePatienceIsSeenAtTheNextQuestion) {
  auto connection = Connection::open(config_);
  constexpr std::chrono::milliseconds kPatience{1};
  EXPECT_FALSE(connection->answers(kPatience));
  const auto got = receive();
  ASSERT_TRUE(got);
  EXPECT_EQ(got->header.method(), "Hello");
  EXPECT_FALSE(connection->answers(kPatience));
  reply(*got, got->header.request_id());
  EXPECT_TRUE(semview::testing::eventually([&] { return connection->answers(kPatience); }));
  // One question was under way all the time.
  router_->set(zmq::sockopt::rcvtimeo, 0);
  EXPECT_FALSE(receive());
}

TEST_F(ConnectionToFakeTest, AReplyToAnotherRequestIsPassedOver) {
  auto connection = Connection::open(config_);
  auto answer = ask(*connection, Repeat::kSafe);
  const auto got = receive();
  ASSERT_TRUE(got);
  reply(*got, got->header.request_id() + 1000);
  reply(*got, got->header.request_id());
  EXPECT_EQ(*answer.get(), "body");
}

TEST_F(ConnectionToFakeTest, ABusyServerIsAskedAgainAfterItsPause) {
  auto connection = Connection::open(config_);
  auto answer = ask(*connection, Repeat::kSafe);
  auto got = receive();
  ASSERT_TRUE(got);
  const Error busy{ErrorCode::kResourceExhausted, "busy", "", "", 20};
  reply(*got, got->header.request_id(), &busy);
  got = receive();
  ASSERT_TRUE(got);
  reply(*got, got->header.request_id());
  EXPECT_TRUE(answer.get());
}

TEST_F(ConnectionToFakeTest, WhatMustNotHappenTwiceIsSentOnce) {
  auto connection = Connection::open(config_);
  auto answer = ask(*connection, Repeat::kNever);
  ASSERT_TRUE(receive());
  const std::string endpoint = config_.endpoint;
  router_.reset();  // the line breaks while the request is under way
  const auto result = answer.get();
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kUnavailable);
}

TEST_F(ConnectionToFakeTest, AServerAtWorkIsWaitedForAndNotOnceItIsGone) {
  config_.timeout = std::chrono::hours(1);
  config_.contact = std::chrono::milliseconds(200);
  auto connection = Connection::open(config_);
  auto answer = ask(*connection, Repeat::kSafe);
  ASSERT_TRUE(receive());
  EXPECT_EQ(answer.wait_for(2 * config_.contact), std::future_status::timeout);
  router_.reset();  // the line breaks while the request is under way
  const auto result = answer.get();
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kUnavailable);
}

TEST_F(ConnectionToFakeTest, WhatIsSafeIsSentAgainWhenTheLineBreaks) {
  auto connection = Connection::open(config_);
  auto answer = ask(*connection, Repeat::kSafe);
  ASSERT_TRUE(receive());
  router_.reset();
  router_ = std::make_unique<zmq::socket_t>(context_, ZMQ_ROUTER);
  router_->set(zmq::sockopt::linger, 0);
  router_->set(zmq::sockopt::rcvtimeo, 10'000);
  // The port is ours again as soon as the old socket has let go.
  ASSERT_TRUE(semview::testing::eventually([this] {
    try {
      router_->bind(config_.endpoint);
      return true;
    } catch (const zmq::error_t&) {
      return false;
    }
  }));
  const auto got = receive();
  ASSERT_TRUE(got);
  reply(*got, got->header.request_id());
  EXPECT_TRUE(answer.get());
}

}  // namespace
}  // namespace semview::test
