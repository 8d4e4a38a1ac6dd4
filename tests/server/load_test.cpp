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
  const std::string body = score_request(set_observation(client), 100).SerializeAsString();
  v1::RequestHeader hurried = RawClient::header("Score", 2);
  hurried.set_deadline_ms(100);
  hurried.set_client_name("hurried");
  const auto work_of_hurried = [this] { return server_->counters().cells_by_client["hurried"]; };
  // While the one worker is busy with another request, time passes for this one.
  HeldView held(*site_, kQuietCell);
  RawClient other(server_->endpoint());
  other.send(RawClient::header("GetViews"), view_request(kQuietCell).SerializeAsString());
  ASSERT_TRUE(eventually([this] { return site_->tiers().cache->counters().waits == 1; }));
  client.send(hurried, body);
  ASSERT_TRUE(eventually([this] { return server_->counters().in_flight == 2; }));
  clock_.advance(milliseconds(101));
  held.release();
  ASSERT_TRUE(other.receive());
  const auto reply = client.receive();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->header.error().code(), v1::ERROR_CODE_DEADLINE_EXCEEDED);
  EXPECT_EQ(reply->header.error().field(), "deadline_ms");
  EXPECT_EQ(server_->counters().expired, 1U);
  EXPECT_EQ(work_of_hurried(), 0U);
  // In time the same request is work.
  EXPECT_FALSE(client.ask(hurried, body).header.has_error());
  EXPECT_GT(work_of_hurried(), 0U);
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
  header.set_deadline_ms(600'000);  // let in, however slow the machine is
  EXPECT_FALSE(greedy.ask(header, large).header.has_error());
  const std::uint64_t cells_of_large = server_->counters().cells_by_client["greedy"];
  constexpr int kLarge = 100;
  for (int i = 0; i < kLarge; ++i) greedy.send(header, large);
  ASSERT_TRUE(eventually([this] { return server_->counters().in_flight >= kLarge / 2; }));

  header.set_client_name("robot");
  const std::string small = score_request(id, 1).SerializeAsString();
  for (int i = 0; i < 5; ++i) {
    server::ServerCounters before = server_->counters();
    // Still under load, or the test says nothing.
    ASSERT_GT(before.in_flight, 10U);
    EXPECT_FALSE(robot.ask(header, small).header.has_error());
    // In turn of arrival all of the greedy client's work would be done first. Fairness lets a part
    // of one request through for each of the robot's two tasks; how much more of it is done depends
    // on how long an answer travels on a busy machine. FairQueueTest counts tasks.
    const std::uint64_t in_front = before.in_flight * cells_of_large;
    const std::uint64_t meanwhile =
        server_->counters().cells_by_client["greedy"] - before.cells_by_client["greedy"];
    EXPECT_LT(meanwhile, in_front / 4);
  }
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

TEST_F(LoadTest, ClientsThatLeaveHoldNothingUp) {
  const std::string id = [this] {
    RawClient client(server_->endpoint());
    return set_observation(client);
  }();
  constexpr int kClients = 20;
  constexpr int kRequests = 5;
  for (int i = 0; i < kClients; ++i) {
    RawClient leaving(server_->endpoint());
    for (int k = 0; k < kRequests; ++k) {
      leaving.send(RawClient::header("Score"), score_request(id, 500).SerializeAsString());
    }
    // It leaves when the server has heard it.
    const auto heard = 1 + static_cast<std::uint64_t>(kRequests * (i + 1));
    ASSERT_TRUE(eventually([&] { return server_->counters().requests >= heard; }));
  }
  EXPECT_TRUE(eventually([this] { return server_->counters().in_flight == 0; }));
  expect_alive();
}

TEST_F(LoadTest, AClientThatNeverReadsHoldsUpNobodyButItself) {
  constexpr std::size_t kInFlight = 100;
  server::ServerConfig config;
  config.limits.max_in_flight_per_client = kInFlight;
  start(config);
  RawClient other(server_->endpoint());
  RawClient silent(server_->endpoint(), zmq::socket_type::dealer, 1);
  v1::ScoreRequest request = score_request(set_observation(other), 500);
  request.set_whole_curve(true);
  const std::string body = request.SerializeAsString();
  // 24 MB of replies: more than the sockets on the way hold.
  for (std::size_t i = 0; i < kInFlight; ++i) silent.send(RawClient::header("Score"), body);
  ASSERT_TRUE(eventually([this] {
    return server_->counters().requests > kInFlight && server_->counters().in_flight == 0;
  }));
  // What it has not read counts as its requests, so it can only fill its own share …
  for (std::size_t i = 0; i < kInFlight; ++i) silent.send(RawClient::header("Score"), body);
  EXPECT_TRUE(eventually([this] { return server_->counters().refused > 0; }));
  // … and others are served as ever.
  EXPECT_FALSE(other.ask(RawClient::header("Score"), body).header.has_error());
}

TEST_F(LoadTest, AMessageFarAboveTheLimitCutsOnlyItsOwnConnection) {
  server::ServerConfig config;
  config.limits.max_message_bytes = 100'000;
  start(config);
  RawClient other(server_->endpoint());
  other.get<v1::HelloReply>("Hello", v1::HelloRequest());
  other.watch_line();
  RawClient flooding(server_->endpoint());
  flooding.get<v1::HelloReply>("Hello", v1::HelloRequest());
  flooding.watch_line();
  flooding.send(RawClient::header("Hello"), std::string(1'000'000, 'x'));
  EXPECT_TRUE(flooding.line_was_cut(std::chrono::seconds(20)));
  other.get<v1::HelloReply>("Hello", v1::HelloRequest());
  EXPECT_FALSE(other.line_was_cut(std::chrono::milliseconds(0)));
  EXPECT_EQ(server_->counters().requests, 3U);
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
  for (std::uint64_t i = 0; i < kCount; ++i) {
    v1::RequestHeader header = RawClient::header("Score", i);
    header.set_deadline_ms(600'000);  // let in, however slow the machine is
    client.send(header, body);
  }
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
