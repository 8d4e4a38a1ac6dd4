// SPDX-License-Identifier: Apache-2.0
/// How a server ends: what is inside is answered, the rest refused, and nothing is used after its
/// end.
#include <chrono>
#include <future>

#include "server/server_fixture.hpp"

namespace semview::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class ShutdownTest : public ServerFixture {};

TEST_F(ShutdownTest, DrainAnswersWhatIsInsideAndRefusesTheRest) {
  HeldView held(*site_, kQuietCell);
  RawClient inside(server_->endpoint());
  constexpr int kCount = 20;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    inside.send(RawClient::header("GetViews", i), view_request(kQuietCell).SerializeAsString());
  }
  ASSERT_TRUE(eventually([this] { return server_->counters().in_flight == kCount; }));
  auto drained = std::async(std::launch::async, [this] { return server_->drain(seconds(60)); });
  RawClient late(server_->endpoint());
  // Nothing inside can end yet, so the server stays until a late one has been refused. One that
  // came before the drain began may have to wait for those inside.
  ASSERT_TRUE(eventually([&] {
    late.send(RawClient::header("ListMaps"), "");
    const auto reply = late.receive(milliseconds(100));
    return reply && reply->header.error().code() == v1::ERROR_CODE_UNAVAILABLE;
  }));
  held.release();
  EXPECT_TRUE(drained.get());
  for (int i = 0; i < kCount; ++i) {
    const auto reply = inside.receive();
    ASSERT_TRUE(reply) << i;
    EXPECT_FALSE(reply->header.has_error()) << reply->header.error().message();
  }
}

TEST_F(ShutdownTest, AServerThatEndsWhileRequestsArePlannedWaitsForItsWorkers) {
  RawClient client(server_->endpoint());
  // Large requests: their planning, which asks how much work is queued, takes a while.
  const std::string body = score_request(set_observation(client), 200'000).SerializeAsString();
  constexpr std::uint64_t kCount = 40;
  for (std::uint64_t i = 0; i < kCount; ++i) client.send(RawClient::header("Score", i), body);
  ASSERT_TRUE(eventually([this] { return server_->counters().in_flight >= kCount / 2; }));
  EXPECT_FALSE(server_->drain(milliseconds(0)));
  server_.reset();
}

}  // namespace
}  // namespace semview::test
