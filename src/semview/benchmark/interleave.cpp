// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/interleave.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <vector>

namespace semview::benchmark {
namespace {

/// Of the calling thread, in which a pool of one thread does all.
double thread_s() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double read(TurnsClock clock) { return clock == TurnsClock::kThread ? thread_s() : now_s(); }

/// Seconds an item of some passes over all of them.
double item_s(const Contender& contender, int passes, ThreadPool& pool, TurnsClock clock) {
  // A few tasks a thread: as the service cuts its work, and no thread ends long before the others.
  const std::size_t grain = std::max<std::size_t>(1, contender.items / (8 * pool.threads()));
  const double start_s = read(clock);
  for (int pass = 0; pass < passes; ++pass) {
    pool.parallel_for(contender.items, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) contender.item(i);
    });
  }
  return (read(clock) - start_s) / (passes * static_cast<double>(contender.items));
}

double turn_s(const Contender& contender, int passes, ThreadPool& pool, TurnsClock clock) {
  contender.item(0);
  return item_s(contender, passes, pool, clock);
}

class Samples {
 public:
  void add(double seconds) { seconds_.push_back(seconds); }
  Timing timing() {
    std::ranges::sort(seconds_);
    return {seconds_.front(), seconds_[seconds_.size() / 2]};
  }

 private:
  std::vector<double> seconds_;
};

}  // namespace

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

TurnsClock clock_for(const ThreadPool& pool) {
  return pool.threads() == 1 ? TurnsClock::kThread : TurnsClock::kWall;
}

std::string_view name_of(TurnsClock clock) {
  return clock == TurnsClock::kThread ? "thread" : "wall";
}

int passes_for(double wanted_s, double pass_s) {
  constexpr double kMostPasses = 100.0;
  if (!(pass_s > 0.0)) return 1;
  return static_cast<int>(std::clamp(std::floor(wanted_s / pass_s), 1.0, kMostPasses));
}

Turns take_turns(const Contender& ours,
                 const Contender& other,
                 ThreadPool& pool,
                 const TurnsConfig& config) {
  const TurnsClock clock = config.clock.value_or(clock_for(pool));
  const double begin_s = now_s();
  const double ours_s = item_s(ours, 1, pool, clock) * static_cast<double>(ours.items);
  const double other_s = item_s(other, 1, pool, clock) * static_cast<double>(other.items);
  const int our_passes = passes_for(other_s / 10.0, ours_s);
  const int other_passes = passes_for(ours_s / 10.0, other_s);
  Samples our_samples;
  Samples other_samples;
  Turns turns;
  while (turns.rounds < config.fewest_rounds ||
         (turns.rounds < config.most_rounds && now_s() - begin_s < config.budget_s)) {
    our_samples.add(turn_s(ours, our_passes, pool, clock));
    other_samples.add(turn_s(other, other_passes, pool, clock));
    ++turns.rounds;
  }
  turns.ours = our_samples.timing();
  turns.other = other_samples.timing();
  turns.clock = clock;
  return turns;
}

Timing time_alone(const Contender& work, ThreadPool& pool, const TurnsConfig& config) {
  const TurnsClock clock = config.clock.value_or(clock_for(pool));
  const double begin_s = now_s();
  static_cast<void>(item_s(work, 1, pool, clock));
  Samples samples;
  for (int round = 0; round < config.fewest_rounds ||
                      (round < config.most_rounds && now_s() - begin_s < config.budget_s);
       ++round) {
    samples.add(item_s(work, 1, pool, clock));
  }
  return samples.timing();
}

}  // namespace semview::benchmark
