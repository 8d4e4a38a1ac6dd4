// SPDX-License-Identifier: Apache-2.0
#include "dispatcher.hpp"

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace semview::server {
namespace {

using std::chrono::milliseconds;

class DispatcherTest : public testing::Test {
 protected:
  Request request(milliseconds budget = milliseconds(1000)) const {
    return {"client", "name", "Method", "body", clock_.now() + budget};
  }

  /// Submits and waits.
  static Result<std::string> ask(Dispatcher& dispatcher, Request request) {
    // Shared: the worker may still be in `set_value` when the answer is here already.
    const auto answered = std::make_shared<std::promise<Result<std::string>>>();
    dispatcher.submit(std::move(request), 1, [answered](Result<std::string> result) {
      answered->set_value(std::move(result));
    });
    return answered->get_future().get();
  }

  ManualClock clock_;
};

TEST_F(DispatcherTest, AllChunksAreDoneBeforeTheAnswer) {
  std::atomic<int> done{0};
  Dispatcher dispatcher(
      3,
      [&done](const Request&) -> Result<Plan> {
        Plan plan;
        for (int i = 0; i < 100; ++i) {
          plan.chunks.push_back({5, [&done]() -> Status {
                                   ++done;
                                   return {};
                                 }});
        }
        plan.finish = [&done]() -> Result<std::string> { return std::to_string(done); };
        return plan;
      },
      clock_);
  const auto result = ask(dispatcher, request());
  ASSERT_TRUE(result);
  EXPECT_EQ(*result, "100");
  EXPECT_EQ(dispatcher.cells_by_client().at("name"), 501U);
}

TEST_F(DispatcherTest, ExpiredWorkIsNotBegun) {
  bool planned = false;
  Dispatcher dispatcher(
      1,
      [&planned](const Request&) -> Result<Plan> {
        planned = true;
        return answer("");
      },
      clock_);
  Request late = request(milliseconds(10));
  clock_.advance(milliseconds(11));
  const auto result = ask(dispatcher, std::move(late));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kDeadlineExceeded);
  EXPECT_FALSE(planned);
}

TEST_F(DispatcherTest, AfterTheDeadlineNoFurtherChunkIsBegun) {
  std::atomic<int> done{0};
  Dispatcher dispatcher(
      1,
      [&](const Request&) -> Result<Plan> {
        Plan plan;
        for (int i = 0; i < 10; ++i) {
          plan.chunks.push_back({1, [&]() -> Status {
                                   if (++done == 3) clock_.advance(milliseconds(2000));
                                   return {};
                                 }});
        }
        plan.finish = []() -> Result<std::string> { return "done"; };
        return plan;
      },
      clock_);
  EXPECT_EQ(ask(dispatcher, request()).error().code, ErrorCode::kDeadlineExceeded);
  EXPECT_EQ(done, 3);
}

TEST_F(DispatcherTest, TheFirstErrorOfAChunkIsTheOneAnswer) {
  std::atomic<int> answers{0};
  std::promise<Error> answered;
  {
    Dispatcher dispatcher(
        4,
        [](const Request&) -> Result<Plan> {
          Plan plan;
          for (int i = 0; i < 50; ++i) {
            plan.chunks.push_back(
                {1, []() -> Status { return fail(ErrorCode::kOutOfRange, "no"); }});
          }
          plan.finish = []() -> Result<std::string> { return "done"; };
          return plan;
        },
        clock_);
    dispatcher.submit(request(), 1, [&](Result<std::string> result) {
      if (++answers == 1) answered.set_value(result.error());
    });
  }
  EXPECT_EQ(answered.get_future().get().code, ErrorCode::kOutOfRange);
  EXPECT_EQ(answers, 1);
}

TEST_F(DispatcherTest, WhatThrowsIsAnInternalErrorAndTheWorkerLives) {
  Dispatcher dispatcher(
      1,
      [](const Request& asked) -> Result<Plan> {
        if (asked.body == "plan") throw std::runtime_error("plan broke");
        Plan plan;
        plan.chunks.push_back({1, [body = asked.body]() -> Status {
                                 if (body == "chunk") throw std::runtime_error("chunk broke");
                                 return {};
                               }});
        plan.finish = []() -> Result<std::string> { return "done"; };
        return plan;
      },
      clock_);
  for (const char* const part : {"plan", "chunk"}) {
    Request bad = request();
    bad.body = part;
    const auto result = ask(dispatcher, bad);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kInternal);
  }
  EXPECT_TRUE(ask(dispatcher, request()));
}

TEST_F(DispatcherTest, TheWaitIsToldFromWhatRequestsHaveCost) {
  std::promise<void> begun;
  std::promise<void> go_on;
  Dispatcher dispatcher(
      1,
      [&](const Request& asked) -> Result<Plan> {
        if (asked.body == "held") {
          begun.set_value();
          go_on.get_future().wait();
          return answer("");
        }
        Plan plan;
        // With its planning 20 cells, 10 ms each.
        plan.chunks.push_back({19, [this]() -> Status {
                                 clock_.advance(milliseconds(200));
                                 return {};
                               }});
        plan.finish = []() -> Result<std::string> { return "done"; };
        return plan;
      },
      clock_);
  EXPECT_EQ(dispatcher.expected_wait("client", "Method"), Duration::zero());
  ASSERT_TRUE(ask(dispatcher, request()));
  Request held = request();
  held.body = "held";
  held.client = "other";
  held.method = "Held";
  const auto nobody_asks = [](const Result<std::string>&) {};
  dispatcher.submit(held, 1, nobody_asks);
  begun.get_future().wait();
  EXPECT_EQ(dispatcher.expected_wait("client", "Method"), Duration::zero());
  dispatcher.submit(request(), 1, nobody_asks);
  dispatcher.submit(request(), 1, nobody_asks);
  EXPECT_EQ(dispatcher.expected_wait("client", "Method"), milliseconds(400));
  EXPECT_EQ(dispatcher.expected_wait("another", 10), milliseconds(100));
  go_on.set_value();
}

TEST_F(DispatcherTest, TheDestructorAnswersWhatIsInside) {
  std::atomic<int> answers{0};
  {
    Dispatcher dispatcher(
        2,
        [](const Request&) -> Result<Plan> {
          Plan plan;
          for (int i = 0; i < 3; ++i) {
            plan.chunks.push_back({1, []() -> Status { return {}; }});
          }
          plan.finish = []() -> Result<std::string> { return "done"; };
          return plan;
        },
        clock_);
    for (int i = 0; i < 100; ++i) {
      dispatcher.submit(request(), 1, [&answers](const Result<std::string>&) { ++answers; });
    }
  }
  EXPECT_EQ(answers, 100);
}

TEST_F(DispatcherTest, AnAbandonedQueueEndsWithoutWork) {
  bool planned = false;
  Dispatcher dispatcher(
      1,
      [&planned](const Request&) -> Result<Plan> {
        planned = true;
        return answer("");
      },
      clock_);
  dispatcher.abandon();
  EXPECT_EQ(ask(dispatcher, request()).error().code, ErrorCode::kUnavailable);
  EXPECT_FALSE(planned);
}

}  // namespace
}  // namespace semview::server
