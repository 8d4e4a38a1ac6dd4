// SPDX-License-Identifier: Apache-2.0
/// Times of two ways to do the same, taken in turn.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>

#include "semview/core/thread_pool.hpp"

namespace semview::benchmark {

/// Some items of work; `item(i)` does the i-th. Called from several threads at once if there are
/// several.
struct Contender {
  std::size_t items = 0;
  std::function<void(std::size_t)> item;
};

/// Of a clock that only goes forward.
double now_s();

/// By that clock.
template <typename Work>
double seconds_of(const Work& work) {
  const double begin_s = now_s();
  work();
  return now_s() - begin_s;
}

/// What a time is read from: of one thread the processor time that it had, so that what else the
/// machine does counts for neither side; of several the wall.
enum class TurnsClock { kThread, kWall };
TurnsClock clock_for(const ThreadPool& pool);
std::string_view name_of(TurnsClock clock);

/// Seconds an item over all rounds.
struct Timing {
  double least_s = 0.0;
  double median_s = 0.0;
};

struct Turns {
  Timing ours;
  Timing other;
  int rounds = 0;                        ///< as many samples of each
  TurnsClock clock = TurnsClock::kWall;  ///< of both

  /// How many times as long the other takes. On a busy machine the least times tell most.
  double ratio() const { return other.least_s / ours.least_s; }
  double median_ratio() const { return other.median_s / ours.median_s; }
};

struct TurnsConfig {
  double budget_s = 0.6;  ///< ends after the round that passes it
  int fewest_rounds = 3;
  int most_rounds = 200;
  /// None: that of the pool. Of work that other threads do only the wall tells.
  std::optional<TurnsClock> clock = {};
};

/// Ours, then the other, round after round in this process, by the same clock: what else the
/// machine does meets both alike. A turn begins with one item that is not timed and gives one
/// sample, so that both have as many; the quicker one repeats its items until a turn has a tenth of
/// the other's time. The first pass of each only warms up.
Turns take_turns(const Contender& ours,
                 const Contender& other,
                 ThreadPool& pool,
                 const TurnsConfig& config);

/// One alone, in the same way.
Timing time_alone(const Contender& work, ThreadPool& pool, const TurnsConfig& config);

/// How many passes of `pass_s` seconds come nearest to `wanted_s` from below, 1 to 100; 1 where a
/// pass is too short for the clock.
int passes_for(double wanted_s, double pass_s);

}  // namespace semview::benchmark
