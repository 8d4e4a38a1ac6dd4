// SPDX-License-Identifier: Apache-2.0
/// How a server ends: what is inside is answered, the rest refused, and nothing is used after its
/// end.
#include <chrono>

#include "server/server_fixture.hpp"

namespace semview::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class ShutdownTest : public ServerFixture {};

TEST_F(ShutdownTest, DrainAnswersWhatIsInsideAndRefusesTheRest) {
  RawClient client(server_->endpoint());
  const std::string id = set_observation(client);
  constexpr int kCount = 20;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    client.send(RawClient::header("Score", i), score_request(id, 20'000).SerializeAsString());
  }
  ASSERT_TRUE(eventually([this] { return server_->counters().in_flight >= kCount / 2; }));
  EXPECT_TRUE(server_->drain(seconds(60)));
  for (int i = 0; i < kCount; ++i) {
    const auto reply = client.receive();
    ASSERT_TRUE(reply) << i;
    if (reply->header.has_error()) {
      EXPECT_EQ(reply->header.error().code(), v1::ERROR_CODE_UNAVAILABLE);
    }
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
