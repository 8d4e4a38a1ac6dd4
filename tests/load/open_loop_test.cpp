// SPDX-License-Identifier: Apache-2.0
#include "client/load/open_loop.hpp"

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "semview/v1/scores.pb.h"

namespace semview::client {
namespace {

using std::chrono::milliseconds;

class NoBodies final : public LoadBodies {
 public:
  const std::string& observation(std::size_t, std::size_t) const override { return empty_; }
  std::string score(std::size_t, std::size_t, const std::string& id) const override { return id; }

 private:
  std::string empty_;
};

/// A server in pretended time: one worker, requests in turn.
class PretendedServer final : public LoadWire {
 public:
  explicit PretendedServer(ManualClock& clock) : clock_(clock) {}

  Duration service = milliseconds(0);         ///< of each request
  TimePoint stalled_from{}, stalled_until{};  ///< nothing is begun in between
  std::function<bool(std::uint64_t)> refuses = [](std::uint64_t) { return false; };
  std::function<bool(std::uint64_t)> expires = [](std::uint64_t) { return false; };
  std::function<bool(std::uint64_t)> forgets = [](std::uint64_t) { return false; };
  std::vector<TimePoint> observed_at;  ///< when SetObservation came
  std::vector<std::size_t> robots;     ///< and from whom
  std::vector<milliseconds> budgets;   ///< of all requests

  void send(std::size_t robot,
            std::uint64_t id,
            std::string_view method,
            std::string_view body,
            milliseconds budget) override {
    budgets.push_back(budget);
    if (method == "SetObservation") {
      observed_at.push_back(clock_.now());
      robots.push_back(robot);
    } else {
      EXPECT_EQ(method, "Score");
      EXPECT_EQ(body, "seen");
    }
    if (forgets(id)) return;
    TimePoint begin = std::max(clock_.now(), free_);
    if (begin >= stalled_from && begin < stalled_until) begin = stalled_until;
    free_ = begin + service;
    v1::SetObservationReply reply;
    reply.set_observation_id("seen");
    Result<std::string> answer = reply.SerializeAsString();
    if (refuses(id)) answer = fail(ErrorCode::kResourceExhausted, "busy");
    if (expires(id)) answer = fail(ErrorCode::kDeadlineExceeded, "late");
    replies_.emplace(free_, LoadReply{id, std::move(answer)});
  }

  std::optional<LoadReply> receive(TimePoint until) override {
    if (replies_.empty() || replies_.begin()->first > until) {
      clock_.advance(until - clock_.now());
      return std::nullopt;
    }
    clock_.advance(std::max(Duration::zero(), replies_.begin()->first - clock_.now()));
    LoadReply reply = std::move(replies_.begin()->second);
    replies_.erase(replies_.begin());
    return reply;
  }

 private:
  ManualClock& clock_;
  TimePoint free_{};
  std::multimap<TimePoint, LoadReply> replies_;
};

class OpenLoopTest : public ::testing::Test {
 protected:
  LoadReport run(LoadConfig config) {
    const auto report = run_open_loop(config, NoBodies(), server_, clock_);
    EXPECT_TRUE(report) << report.error().message;
    return *report;
  }

  ManualClock clock_;
  PretendedServer server_{clock_};
};

TEST_F(OpenLoopTest, RobotsBeginInTurnAtTheirTimes) {
  LoadConfig config;
  config.robots = 4;
  config.rate_hz = 2.0;
  config.seconds = 2.0;
  const LoadReport report = run(config);
  EXPECT_EQ(report.cycles, 16U);
  EXPECT_EQ(report.answered, 16U);
  ASSERT_EQ(server_.observed_at.size(), 16U);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(server_.observed_at[i], TimePoint(milliseconds(125 * i)));
    EXPECT_EQ(server_.robots[i], i % 4);
  }
  EXPECT_EQ(report.max_ms, 0.0);
  EXPECT_DOUBLE_EQ(report.goodput_hz(), 8.0);
}

TEST_F(OpenLoopTest, ACycleTakesBothItsRequests) {
  server_.service = milliseconds(10);
  const LoadReport report = run({});
  EXPECT_EQ(report.cycles, 10U);
  EXPECT_DOUBLE_EQ(report.p50_ms, 20.0);
  EXPECT_DOUBLE_EQ(report.p99_ms, 20.0);
}

TEST_F(OpenLoopTest, AStallIsChargedForEveryCycleThatItHoldsUp) {
  // 100 cycles a second for two seconds; the server stands still for one of them. Whoever waited
  // for each answer before the next request would see one slow request and 100 quick ones.
  LoadConfig config;
  config.robots = 50;
  config.seconds = 2.0;
  server_.stalled_from = TimePoint(milliseconds(500));
  server_.stalled_until = TimePoint(milliseconds(1500));
  const LoadReport report = run(config);
  EXPECT_EQ(report.answered, 200U);
  EXPECT_DOUBLE_EQ(report.max_ms, 1000.0);
  EXPECT_DOUBLE_EQ(report.p99_ms, 980.0);
  EXPECT_DOUBLE_EQ(report.p95_ms, 900.0);
  // Held up by less than 250 ms: the last quarter of the stall.
  EXPECT_EQ(report.in_time, 100U + 25U);
  EXPECT_EQ(server_.observed_at.size(), 200U) << "sent at their times all the same";
}

TEST_F(OpenLoopTest, AnOverloadedServerFallsBehindFurtherAndFurther) {
  LoadConfig config;
  config.robots = 10;
  config.rate_hz = 10.0;
  config.seconds = 4.0;
  server_.service = milliseconds(10);  // 20 ms a cycle, one comes every 10
  const LoadReport report = run(config);
  EXPECT_GT(report.timed_out, 0U);
  EXPECT_EQ(report.answered + report.timed_out, report.cycles);
  EXPECT_EQ(report.p99_ms, 2000.0) << "lost cycles count as long as the limit";
  EXPECT_LT(report.goodput_hz(), 50.0);
}

TEST_F(OpenLoopTest, RefusalsAreCountedAndMakeNoServerQuick) {
  server_.refuses = [](std::uint64_t id) { return id % 3 == 0; };
  const LoadReport report = run({});
  EXPECT_GT(report.refused, 0U);
  EXPECT_EQ(report.answered + report.refused, report.cycles);
  EXPECT_EQ(report.max_ms, 2000.0);
}

TEST_F(OpenLoopTest, TheServerIsToldWhatIsLeftOfTheTimeInWhichAnAnswerIsOfUse) {
  server_.service = milliseconds(100);
  LoadConfig config;
  config.seconds = 0.5;
  config.rate_hz = 2.0;
  run(config);
  EXPECT_EQ(server_.budgets, (std::vector{milliseconds(250), milliseconds(150)}));
}

TEST_F(OpenLoopTest, WhatIsTooLateForTheServerIsLost) {
  server_.expires = [](std::uint64_t id) { return id % 2 == 0; };
  const LoadReport report = run({});
  EXPECT_EQ(report.timed_out, report.cycles);
  EXPECT_EQ(report.failed, 0U);
  EXPECT_EQ(report.p50_ms, 2000.0);
}

TEST_F(OpenLoopTest, ARunEndsThoughNothingIsEverAnswered) {
  server_.forgets = [](std::uint64_t) { return true; };
  LoadConfig config;
  config.seconds = 1.0;
  const LoadReport report = run(config);
  EXPECT_EQ(report.timed_out, report.cycles);
  EXPECT_EQ(report.answered, 0U);
  EXPECT_LE(clock_.now(), TimePoint(milliseconds(3000)));
}

TEST_F(OpenLoopTest, LoadsBeyondTheBoundsAreRefused) {
  const auto field_of = [&](std::size_t robots, double rate_hz, double seconds) {
    LoadConfig config;
    config.robots = robots;
    config.rate_hz = rate_hz;
    config.seconds = seconds;
    return run_open_loop(config, NoBodies(), server_, clock_).error().field;
  };
  EXPECT_EQ(field_of(0, 2.0, 1.0), "--robots");
  EXPECT_EQ(field_of(kMaxRobots + 1, 2.0, 1.0), "--robots");
  EXPECT_EQ(field_of(1, 0.0, 1.0), "--rate");
  EXPECT_EQ(field_of(1, std::nan(""), 1.0), "--rate");
  EXPECT_EQ(field_of(1, 2.0, 1e9), "--seconds");
  EXPECT_EQ(field_of(1000, 100.0, 600.0), "--seconds");
}

TEST(LoadReportTest, APercentileIsAnEntryThatWasMeasured) {
  const std::vector<double> hundred = [] {
    std::vector<double> numbers;
    for (int i = 1; i <= 100; ++i) numbers.push_back(i);
    return numbers;
  }();
  EXPECT_EQ(percentile(hundred, 0.50), 50.0);
  EXPECT_EQ(percentile(hundred, 0.99), 99.0);
  EXPECT_EQ(percentile(hundred, 1.0), 100.0);
  EXPECT_EQ(percentile({7.0}, 0.5), 7.0);
}

}  // namespace
}  // namespace semview::client
