// SPDX-License-Identifier: Apache-2.0
#include "outbox.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace semview::server {
namespace {

class OutboxTest : public testing::Test {
 protected:
  Outbox make(std::uint64_t max_bytes = 1000, std::size_t max_replies = 10) {
    return Outbox(
        [this](const Outgoing& reply) {
          const Sent sent = socket_[reply.client];
          if (sent == Sent::kSent) sent_.push_back(reply.client + reply.body);
          return sent;
        },
        max_bytes,
        max_replies);
  }

  std::map<std::string, Sent> socket_;
  std::vector<std::string> sent_;
};

TEST_F(OutboxTest, AReplyToWhoReadsGoesAtOnce) {
  Outbox outbox = make();
  outbox.deliver({"a", false, "", "1"});
  EXPECT_EQ(sent_, (std::vector<std::string>{"a1"}));
  EXPECT_TRUE(outbox.empty());
}

TEST_F(OutboxTest, RepliesWaitInOrderAndHoldUpNobodyElse) {
  Outbox outbox = make();
  socket_["slow"] = Sent::kFull;
  outbox.deliver({"slow", false, "", "1"});
  outbox.deliver({"slow", false, "", "2"});
  outbox.deliver({"b", false, "", "1"});
  EXPECT_EQ(outbox.waiting("slow"), 2U);
  socket_["slow"] = Sent::kSent;
  // Behind the two that wait, though the socket would take it.
  outbox.deliver({"slow", false, "", "3"});
  outbox.flush();
  EXPECT_EQ(sent_, (std::vector<std::string>{"b1", "slow1", "slow2", "slow3"}));
  EXPECT_TRUE(outbox.empty());
  EXPECT_EQ(outbox.undelivered(), 0U);
}

TEST_F(OutboxTest, WhoHasGoneIsForgottenAndCounted) {
  Outbox outbox = make();
  socket_["slow"] = Sent::kFull;
  outbox.deliver({"slow", false, "", "1"});
  outbox.deliver({"slow", false, "", "2"});
  socket_["slow"] = Sent::kGone;
  outbox.flush();
  outbox.deliver({"slow", false, "", "3"});
  EXPECT_TRUE(outbox.empty());
  EXPECT_EQ(outbox.undelivered(), 3U);
}

TEST_F(OutboxTest, BeyondItsLimitsRepliesAreDroppedAndCounted) {
  Outbox outbox = make(100, 3);
  socket_["a"] = Sent::kFull;
  socket_["b"] = Sent::kFull;
  for (int i = 0; i < 5; ++i) outbox.deliver({"a", false, "", ""});
  EXPECT_EQ(outbox.waiting("a"), 3U);
  EXPECT_EQ(outbox.undelivered(), 2U);
  outbox.deliver({"b", false, "", std::string(200, 'x')});
  EXPECT_EQ(outbox.waiting("b"), 0U);
  // What was sent makes room again.
  outbox.deliver({"b", false, "", std::string(90, 'x')});
  outbox.deliver({"b", false, "", std::string(90, 'x')});
  EXPECT_EQ(outbox.waiting("b"), 1U);
  socket_["b"] = Sent::kSent;
  outbox.flush();
  socket_["b"] = Sent::kFull;
  outbox.deliver({"b", false, "", std::string(90, 'x')});
  EXPECT_EQ(outbox.waiting("b"), 1U);
}

}  // namespace
}  // namespace semview::server
