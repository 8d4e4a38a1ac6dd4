// SPDX-License-Identifier: Apache-2.0
/// What a server does under load: fairness, overload, expired requests, clients that read late.
#include <algorithm>
#include <chrono>
#include <set>

#include "plan.hpp"
#include "server/server_fixture.hpp"

namespace semview::test {
namespace {

using std::chrono::milliseconds;

class LoadTest : public ServerFixture {};

TEST_F(LoadTest, ExpiredRequestsAreAnsweredAndNotBegun) {
  server::ServerConfig config;
  config.workers = 1;
  start(config, clock_);
  RawClient client(server_->endpoint());
  const std::string id = set_observation(client);
  // While the one worker is busy with the first, time passes for the second.
  v1::RequestHeader hurried = RawClient::header("Score", 2);
  hurried.set_deadline_ms(100);
  client.send(RawClient::header("Score", 1), score_request(id, 200'000).SerializeAsString());
  client.send(hurried, score_request(id, 1).SerializeAsString());
  ASSERT_TRUE(eventually([this] { return server_->counters().in_flight >= 2; }));
  clock_.advance(milliseconds(101));
  bool expired = false;
  for (int i = 0; i < 2; ++i) {
    const auto reply = client.receive();
    ASSERT_TRUE(reply);
    if (reply->header.request_id() == 2 && reply->header.has_error()) {
      expired = true;
      EXPECT_EQ(reply->header.error().code(), v1::ERROR_CODE_DEADLINE_EXCEEDED);
      EXPECT_EQ(reply->header.error().field(), "deadline_ms");
    }
  }
  EXPECT_TRUE(expired);
}

TEST_F(LoadTest, AGreedyClientDoesNotStarveAnother) {
  server::ServerConfig config;
  config.workers = 1;
  config.limits.max_in_flight_per_client = 10'000;
  start(config);
  RawClient greedy(server_->endpoint());
  RawClient robot(server_->endpoint());
  const std::string id = set_observation(greedy);
  const std::string large = score_request(id, 2000).SerializeAsString();
  v1::RequestHeader header = RawClient::header("Score");
  header.set_client_name("greedy");
  constexpr int kLarge = 100;
  for (int i = 0; i < kLarge; ++i) greedy.send(header, large);
  ASSERT_TRUE(eventually([this] { return server_->counters().in_flight >= kLarge / 2; }));

  header.set_client_name("robot");
  const std::string small = score_request(id, 1).SerializeAsString();
  const auto greedy_cells = [this] { return server_->counters().cells_by_client["greedy"]; };
  constexpr int kSmall = 20;
  std::uint64_t most = 0;
  for (int i = 0; i < kSmall; ++i) {
    const std::uint64_t before = greedy_cells();
    EXPECT_FALSE(robot.ask(header, small).header.has_error());
    most = std::max(most, greedy_cells() - before);
  }
  // Still under load, or the test says nothing.
  ASSERT_GT(server_->counters().in_flight, 10U);
  // A small request is two tasks (plan and chunk); each waits for the one at work and may let
  // one more go first; and one ends between the answer and the count. All together never a whole
  // large request, which is some 1200 cells.
  EXPECT_LE(most, 6 * server::kCellsPerChunk);
}

TEST_F(LoadTest, OverloadIsRefusedAtOnce) {
  server::ServerConfig config;
  config.workers = 1;
  config.limits.max_in_flight_per_client = 3;
  start(config);
  RawClient client(server_->endpoint());
  const std::string id = set_observation(client);
  const std::string body = score_request(id, 20'000).SerializeAsString();
  for (std::uint64_t i = 0; i < 20; ++i) client.send(RawClient::header("Score", i), body);
  int refused = 0;
  for (int i = 0; i < 20; ++i) {
    const auto reply = client.receive();
    ASSERT_TRUE(reply);
    if (!reply->header.has_error()) continue;
    ++refused;
    EXPECT_EQ(reply->header.error().code(), v1::ERROR_CODE_RESOURCE_EXHAUSTED);
    EXPECT_GT(reply->header.error().retry_after_ms(), 0U);
  }
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, 20);
  EXPECT_EQ(server_->counters().refused, static_cast<std::uint64_t>(refused));
}

TEST_F(LoadTest, ClientsThatLeaveOrDoNotReadHoldNothingUp) {
  const std::string id = [this] {
    RawClient client(server_->endpoint());
    return set_observation(client);
  }();
  for (int i = 0; i < 20; ++i) {
    RawClient leaving(server_->endpoint());
    for (int k = 0; k < 5; ++k) {
      leaving.send(RawClient::header("Score"), score_request(id, 500).SerializeAsString());
    }
  }
  expect_alive();
}

TEST_F(LoadTest, AClientThatReadsLateGetsEveryReply) {
  server::ServerConfig config;
  config.limits.max_in_flight_per_client = 200;
  start(config);
  RawClient client(server_->endpoint(), zmq::socket_type::dealer, 1);
  v1::ScoreRequest request = score_request(set_observation(client), 500);
  request.set_whole_curve(true);
  const std::string body = request.SerializeAsString();
  // 24 MB of replies: more than the sockets on the way hold.
  constexpr int kCount = 100;
  for (std::uint64_t i = 0; i < kCount; ++i) client.send(RawClient::header("Score", i), body);
  ASSERT_TRUE(eventually([this] {
    return server_->counters().requests >= kCount && server_->counters().in_flight == 0;
  }));
  expect_alive();
  std::set<std::uint64_t> ids;
  for (int i = 0; i < kCount; ++i) {
    const auto reply = client.receive();
    ASSERT_TRUE(reply) << i;
    EXPECT_FALSE(reply->header.has_error()) << reply->header.error().message();
    ids.insert(reply->header.request_id());
  }
  EXPECT_EQ(ids.size(), static_cast<std::size_t>(kCount));
  EXPECT_EQ(server_->counters().undelivered, 0U);
}

}  // namespace
}  // namespace semview::test
