// SPDX-License-Identifier: Apache-2.0
/// Requests that would be begun too late are refused at once, and no others.
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "admission.hpp"
#include "semview/cache/view_cache.hpp"
#include "server/server_fixture.hpp"

namespace semview::test {
namespace {

using std::chrono::milliseconds;

class OverloadTest : public ServerFixture {
 protected:
  static constexpr CellIndex kSlowCell{6, 5};
  static constexpr CellIndex kBusyCell{7, 5};

  /// A server in pretended time with one worker, which knows that the view of a cell takes a
  /// second and is at work on another until `busy_` is released.
  void keep_busy() {
    server::ServerConfig config;
    config.workers = 1;
    start(config, clock_);
    other_ = std::make_unique<RawClient>(server_->endpoint());
    HeldView slow(*site_, kSlowCell);
    ask(*other_, kSlowCell);
    ASSERT_TRUE(eventually([this] { return waits() == 1; }));
    clock_.advance(std::chrono::seconds(1));
    slow.release();
    ASSERT_TRUE(other_->receive());
    busy_ = std::make_unique<HeldView>(*site_, kBusyCell);
    ask(*other_, kBusyCell);
    ASSERT_TRUE(eventually([this] { return waits() == 2; }));
  }
  void TearDown() override { busy_.reset(); }

  std::uint64_t waits() const { return site_->tiers().cache->counters().waits; }

  static void ask(RawClient& client, const CellIndex& cell, milliseconds budget = milliseconds(0)) {
    v1::RequestHeader header = RawClient::header("GetViews");
    header.set_deadline_ms(static_cast<std::uint32_t>(budget.count()));
    client.send(header, view_request(cell).SerializeAsString());
  }

  std::unique_ptr<HeldView> busy_;
  std::unique_ptr<RawClient> other_;
};

TEST_F(OverloadTest, WhatWouldBeBegunTooLateIsRefusedWhileTheOthersWait) {
  ASSERT_NO_FATAL_FAILURE(keep_busy());
  // Half of five seconds may go by: there is room behind none, one and two of these.
  constexpr std::size_t kClients = 8;
  constexpr std::size_t kAdmitted = 3;
  std::vector<std::unique_ptr<RawClient>> clients;
  for (std::size_t i = 0; i < kClients; ++i) {
    clients.push_back(std::make_unique<RawClient>(server_->endpoint()));
    ask(*clients.back(), kQuietCell, std::chrono::seconds(5));
  }
  const auto is_refused = [](const std::unique_ptr<RawClient>& client) {
    const auto reply = client->receive(milliseconds(0));
    if (!reply) return false;
    EXPECT_EQ(reply->header.error().code(), v1::ERROR_CODE_RESOURCE_EXHAUSTED);
    EXPECT_GT(reply->header.error().retry_after_ms(), 0U);
    EXPECT_NE(reply->header.error().hint(), "");
    return true;
  };
  ASSERT_TRUE(eventually([&] {
    std::erase_if(clients, is_refused);
    return clients.size() <= kAdmitted;
  }));
  EXPECT_EQ(server_->counters().refused, kClients - kAdmitted);
  busy_->release();
  for (const auto& client : clients) {
    const auto reply = client->receive();
    ASSERT_TRUE(reply);
    EXPECT_FALSE(reply->header.has_error()) << reply->header.error().message();
  }
}

TEST_F(OverloadTest, AGreedyClientGetsItselfRefusedAndNobodyElse) {
  ASSERT_NO_FATAL_FAILURE(keep_busy());
  RawClient greedy(server_->endpoint());
  for (int i = 0; i < 20; ++i) ask(greedy, kQuietCell, std::chrono::seconds(5));
  ASSERT_TRUE(eventually([this] { return server_->counters().refused == 17; }));
  RawClient robot(server_->endpoint());
  ask(robot, kQuietCell, std::chrono::seconds(3));
  ASSERT_TRUE(eventually([this] { return server_->counters().in_flight == 5; }));
  EXPECT_EQ(server_->counters().refused, 17U);
  busy_->release();
  const auto reply = robot.receive();
  ASSERT_TRUE(reply);
  EXPECT_FALSE(reply->header.has_error()) << reply->header.error().message();
}

TEST_F(OverloadTest, WhoeverHasTimeIsLetIn) {
  ASSERT_NO_FATAL_FAILURE(keep_busy());
  RawClient hurried(server_->endpoint());
  RawClient patient(server_->endpoint());
  for (int i = 0; i < 5; ++i) ask(patient, kQuietCell, std::chrono::minutes(1));
  ASSERT_TRUE(eventually([this] { return server_->counters().in_flight == 6; }));
  ask(hurried, kQuietCell, milliseconds(100));
  const auto refusal = hurried.receive();
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->header.error().code(), v1::ERROR_CODE_RESOURCE_EXHAUSTED);
  EXPECT_EQ(server_->counters().refused, 1U);
}

TEST_F(OverloadTest, UnderALightLoadNothingIsRefused) {
  server::ServerConfig config;
  config.workers = 1;
  start(config);
  constexpr int kClients = 4;
  constexpr std::uint64_t kRequests = 20;
  std::vector<std::thread> robots;
  for (int i = 0; i < kClients; ++i) {
    robots.emplace_back([this] {
      RawClient robot(server_->endpoint());
      for (std::uint64_t k = 0; k < kRequests; ++k) {
        const std::string body = score_request(set_observation(robot), 300).SerializeAsString();
        EXPECT_FALSE(robot.ask(RawClient::header("Score", k), body).header.has_error());
      }
    });
  }
  for (std::thread& robot : robots) robot.join();
  EXPECT_EQ(server_->counters().refused, 0U);
}

TEST(CheckWaitTest, AnObservationLeavesTimeForItsScores) {
  using server::check_wait;
  constexpr milliseconds kBudget(1000);
  EXPECT_TRUE(check_wait("Score", milliseconds(500), kBudget));
  EXPECT_EQ(check_wait("Score", milliseconds(501), kBudget).error().code,
            ErrorCode::kResourceExhausted);
  EXPECT_TRUE(check_wait("SetObservation", milliseconds(83), kBudget));
  EXPECT_FALSE(check_wait("SetObservation", milliseconds(84), kBudget));
  EXPECT_TRUE(check_wait("Score", Duration::zero(), milliseconds(1)));
}

}  // namespace
}  // namespace semview::test
