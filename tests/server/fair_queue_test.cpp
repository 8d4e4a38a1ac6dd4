// SPDX-License-Identifier: Apache-2.0
#include "fair_queue.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace semview::server {
namespace {

/// Tasks that write down whose they were.
class FairQueueTest : public testing::Test {
 protected:
  void push(const std::string& client, std::uint64_t cells, int count = 1) {
    for (int i = 0; i < count; ++i) {
      ASSERT_TRUE(queue_.push(client, {cells, [this, client] { served_.push_back(client); }}));
    }
  }
  /// Work that one worker is expected to take a second a cell for.
  void push_slow(const std::string& client, std::uint64_t cells, int count = 1) {
    for (int i = 0; i < count; ++i) {
      ASSERT_TRUE(queue_.push(client, {cells, [] {}, {cells, seconds(cells)}}));
    }
  }
  static Duration seconds(std::uint64_t count) { return std::chrono::seconds(count); }
  void serve(int count) {
    for (int i = 0; i < count; ++i) queue_.pop()->run();
  }

  FairQueue queue_;
  std::vector<std::string> served_;
};

TEST_F(FairQueueTest, OneClientIsServedInTheOrderOfItsTasks) {
  std::vector<int> order;
  for (int i = 0; i < 5; ++i) queue_.push("a", {1, [&order, i] { order.push_back(i); }});
  serve(5);
  EXPECT_EQ(order, (std::vector{0, 1, 2, 3, 4}));
}

TEST_F(FairQueueTest, ClientsWithEqualTasksTakeTurns) {
  push("a", 64, 4);
  push("b", 64, 2);
  serve(4);
  EXPECT_EQ(served_, (std::vector<std::string>{"a", "b", "a", "b"}));
}

TEST_F(FairQueueTest, SharesAreOfWorkAndNotOfTasks) {
  push("big", 64, 100);
  push("small", 1, 1000);
  std::map<std::string, int> cells;
  for (int i = 0; i < 660; ++i) {
    const auto task = queue_.pop();
    task->run();
    cells[served_.back()] += static_cast<int>(task->cells);
  }
  EXPECT_NEAR(cells["big"], cells["small"], 64);
}

TEST_F(FairQueueTest, ANewcomerWaitsForOneTaskAtMost) {
  push("greedy", 64, 100);
  serve(50);
  push("robot", 1);
  serve(2);
  EXPECT_TRUE(served_[50] == "robot" || served_[51] == "robot");
}

TEST_F(FairQueueTest, IdlingGivesNoCredit) {
  push("a", 64, 100);
  push("b", 64, 1);
  serve(60);
  push("b", 64, 30);
  served_.clear();
  serve(20);
  EXPECT_NEAR(static_cast<double>(std::count(served_.begin(), served_.end(), "b")), 10.0, 1.0);
}

TEST_F(FairQueueTest, ComingBackAtOnceGivesNoSecondTurn) {
  // A client that always has one task only must not be first each time.
  push("many", 64, 100);
  push("one", 64);
  for (int i = 0; i < 40; ++i) {
    serve(1);
    if (served_.back() == "one") push("one", 64);
  }
  EXPECT_NEAR(static_cast<double>(std::count(served_.begin(), served_.end(), "one")), 20.0, 1.0);
}

TEST_F(FairQueueTest, WhatWaitsIsNotOvertakenByEverMoreNewcomers) {
  // Each client has a task, and another as soon as that one is done, while more and more come.
  push("a", 32);
  push("b", 32);
  int served_before = 0;
  for (int i = 0; i < 100; ++i) {
    push("newcomer" + std::to_string(i), 32);
    serve(1);
    if (i == 0) {
      ASSERT_EQ(served_.back(), "a");
      push("a", 250);
    } else if (served_.back() == "a") {
      served_before = i;
      break;
    }
  }
  EXPECT_GT(served_before, 0);
  EXPECT_LT(served_before, 10);
}

TEST_F(FairQueueTest, QueuedCellsAreThoseWaiting) {
  push("a", 10, 2);
  push("b", 5);
  EXPECT_EQ(queue_.queued_cells(), 25U);
  serve(3);
  EXPECT_EQ(queue_.queued_cells(), 0U);
}

TEST_F(FairQueueTest, ItsOwnTasksComeFirstAllOfThem) {
  EXPECT_EQ(queue_.expected_wait("a", 10), Duration::zero());
  push_slow("a", 64, 3);
  EXPECT_EQ(queue_.expected_wait("a", 1), seconds(192));
  serve(1);
  EXPECT_EQ(queue_.expected_wait("a", 1), seconds(128));
  serve(2);
  EXPECT_EQ(queue_.expected_wait("a", 1), Duration::zero());
}

TEST_F(FairQueueTest, OfAGreedyClientNoMoreComesFirstThanItsShare) {
  push_slow("greedy", 64, 1000);
  EXPECT_EQ(queue_.expected_wait("robot", 30), seconds(30));
  EXPECT_EQ(queue_.expected_wait("greedy", 30), seconds(64'000));
  push_slow("robot", 30);
  EXPECT_EQ(queue_.expected_wait("robot", 10), seconds(30 + 40));
}

TEST_F(FairQueueTest, AClientThatHasHadItsShareWaitsLongerThanANewcomer) {
  push_slow("a", 64, 2);
  push_slow("b", 64, 10);
  serve(4);
  push("a", 64);
  serve(1);
  EXPECT_EQ(served_.back(), "a") << "it was level with the other";
  EXPECT_EQ(queue_.expected_wait("a", 1), seconds(65));
  EXPECT_LT(queue_.expected_wait("new", 1), seconds(64));
}

TEST_F(FairQueueTest, AClosedQueueGivesOutWhatIsInsideAndThenEnds) {
  push("a", 1, 2);
  queue_.close();
  EXPECT_FALSE(queue_.push("a", {1, [] {}}));
  EXPECT_TRUE(queue_.pop());
  EXPECT_TRUE(queue_.pop());
  EXPECT_FALSE(queue_.pop());
}

TEST_F(FairQueueTest, ManyThreadsServeEachTaskOnce) {
  std::atomic<int> done{0};
  std::vector<std::thread> workers;
  for (int i = 0; i < 4; ++i) {
    workers.emplace_back([this] {
      while (auto task = queue_.pop()) task->run();
    });
  }
  for (int i = 0; i < 1000; ++i) {
    queue_.push("client" + std::to_string(i % 7), {1, [&done] { ++done; }});
  }
  queue_.close();
  for (std::thread& worker : workers) worker.join();
  EXPECT_EQ(done, 1000);
}

}  // namespace
}  // namespace semview::server
