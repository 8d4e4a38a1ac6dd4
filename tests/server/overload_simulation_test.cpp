// SPDX-License-Identifier: Apache-2.0
/// Robots and a server in pretended time: how many are answered in time under which load. Queue,
/// costs and the rule of who is let in are the server's; its threads and sockets are left out.
#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "admission.hpp"
#include "fair_queue.hpp"
#include "work_costs.hpp"

namespace semview::server {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr int kWorkers = 2;
constexpr Duration kBudget = milliseconds(250);
constexpr std::uint64_t kChunk = 64;

/// What a cycle costs: an observation, then the scores of so many cells.
struct Cycle {
  Duration observation{};
  Duration scores{};
  std::uint64_t cells = 0;

  double most_hz() const {
    return kWorkers / std::chrono::duration<double>(observation + scores).count();
  }
};

struct Outcome {
  int in_time = 0;
  int refused = 0;
  int late = 0;
};

class Simulation {
 public:
  Simulation(const Cycle& cycle, int robots) : cycle_(cycle) {
    constexpr double kRate_hz = 2.0;
    for (int i = 0; i < robots * static_cast<int>(kRate_hz * kSeconds); ++i) {
      const std::chrono::duration<double> due(i / (robots * kRate_hz));
      at(std::chrono::duration_cast<Duration>(due),
         [this, robot = "robot" + std::to_string(i % robots)] { observe(robot); });
    }
  }
  static constexpr int kSeconds = 2;

  Outcome run() {
    while (!events_.empty()) {
      const auto event = events_.extract(events_.begin());
      now_ = event.key();
      event.mapped()();
    }
    return outcome_;
  }

 private:
  void at(Duration time, std::function<void()> event) { events_.emplace(time, std::move(event)); }

  /// Some tasks take twice as long as others.
  Duration about(Duration time) {
    return std::chrono::duration_cast<Duration>(
        std::uniform_real_distribution<double>(0.67, 1.33)(random_) * time);
  }

  bool admitted(const std::string& robot,
                const std::string& method,
                std::uint64_t cells,
                Duration deadline) {
    if (check_wait(method, queue_.expected_wait(robot, cells) / kWorkers, deadline - now_)) {
      return true;
    }
    ++outcome_.refused;
    return false;
  }

  /// `run` gives how long it takes, zero if it was too late; then `done` follows.
  void push(const std::string& robot,
            std::uint64_t cells,
            const Work& expected,
            std::function<Duration()> run,
            std::function<void(Duration)> done) {
    const auto task = [this, run = std::move(run), done = std::move(done)] {
      const Duration took = run();
      at(now_ + took, [this, took, done] {
        ++idle_;
        if (took > Duration::zero()) done(took);
        serve();
      });
    };
    queue_.push(robot, {cells, task, expected});
    ++queued_;
    serve();
  }
  void serve() {
    for (; idle_ > 0 && queued_ > 0; --queued_) {
      --idle_;
      queue_.pop()->run();
    }
  }

  void observe(const std::string& robot) {
    const Duration deadline = now_ + kBudget;
    const Work expected = costs_.of_purpose(robot, "SetObservation");
    if (!admitted(robot, "SetObservation", expected.cells, deadline)) return;
    constexpr std::uint64_t kCells = 32;
    push(
        robot,
        kCells,
        expected,
        [this, deadline] { return begin(deadline, cycle_.observation); },
        [this, robot, deadline](Duration took) {
          costs_.add_request(robot, "SetObservation", {kCells, took}, 0);
          score(robot, deadline);
        });
  }

  void score(const std::string& robot, Duration deadline) {
    if (!admitted(robot, "Score", costs_.of_purpose(robot, "Score").cells, deadline)) return;
    costs_.add_request(robot, "Score", {}, cycle_.cells);
    const auto left = std::make_shared<std::uint64_t>(cycle_.cells);
    for (std::uint64_t first = 0; first < cycle_.cells; first += kChunk) {
      const std::uint64_t cells = std::min(kChunk, cycle_.cells - first);
      push(
          robot,
          cells,
          costs_.of_part(robot, "Score", cells),
          [this, deadline, cells, left] {
            if (*left == 0) return Duration::zero();
            const Duration took = begin(deadline, cycle_.scores * cells / cycle_.cells);
            if (took == Duration::zero()) *left = 0;
            return took;
          },
          [this, robot, deadline, cells, left](Duration took) {
            costs_.add_part(robot, "Score", {cells, took});
            if (*left == 0) return;
            *left -= cells;
            if (*left == 0) ++(now_ <= deadline ? outcome_.in_time : outcome_.late);
          });
    }
  }

  Duration begin(Duration deadline, Duration work) {
    if (now_ <= deadline) return about(work);
    ++outcome_.late;
    return Duration::zero();
  }

  const Cycle cycle_;
  FairQueue queue_;
  WorkCosts costs_;
  std::multimap<Duration, std::function<void()>> events_;
  Duration now_{};
  int idle_ = kWorkers;
  int queued_ = 0;
  std::mt19937 random_{1};
  Outcome outcome_;
};

class OverloadSimulationTest : public testing::TestWithParam<Cycle> {
 protected:
  /// Robots whose cycles are so many times what the workers can do.
  int robots(double load) const { return static_cast<int>(load * GetParam().most_hz() / 2.0); }
};

TEST_P(OverloadSimulationTest, WhoIsNotTooManyIsNeverRefused) {
  for (const double load : {0.1, 0.4, 0.7}) {
    const Outcome outcome = Simulation(GetParam(), robots(load)).run();
    EXPECT_GT(outcome.in_time, 0);
    EXPECT_EQ(outcome.refused, 0) << load;
    EXPECT_EQ(outcome.late, 0) << load;
  }
}

TEST_P(OverloadSimulationTest, AmongTooManyAsManyAreAnsweredInTimeAsCanBe) {
  for (const double load : {1.2, 2.0, 5.0}) {
    const Outcome outcome = Simulation(GetParam(), robots(load)).run();
    const double most = GetParam().most_hz() * Simulation::kSeconds;
    EXPECT_GT(outcome.in_time, 0.85 * most) << load;
    EXPECT_GT(outcome.refused, 0) << load;
    EXPECT_LT(outcome.late, 0.02 * most) << load;
  }
}

INSTANTIATE_TEST_SUITE_P(Loads,
                         OverloadSimulationTest,
                         testing::Values(Cycle{milliseconds(1), milliseconds(15), 2000},
                                         Cycle{milliseconds(1), microseconds(700), 270},
                                         Cycle{milliseconds(5), milliseconds(2), 270}));

}  // namespace
}  // namespace semview::server
