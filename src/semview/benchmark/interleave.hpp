// SPDX-License-Identifier: Apache-2.0
/// Times of two ways to do the same, taken in turn.
#pragma once

#include <cstddef>
#include <functional>

#include "semview/core/thread_pool.hpp"

namespace semview::benchmark {

/// Some items of work; `item(i)` does the i-th. Called from several threads at once if there are
/// several.
struct Contender {
  std::size_t items = 0;
  std::function<void(std::size_t)> item;
};

/// Seconds an item, by the clock, over all rounds.
struct Timing {
  double least_s = 0.0;
  double median_s = 0.0;
};

struct Turns {
  Timing ours;
  Timing other;
  int rounds = 0;

  /// How many times as long the other takes. On a busy machine the least times tell most.
  double ratio() const { return other.least_s / ours.least_s; }
  double median_ratio() const { return other.median_s / ours.median_s; }
};

struct TurnsConfig {
  double budget_s = 0.6;  ///< ends after the round that passes it
  int fewest_rounds = 3;
  int most_rounds = 200;
};

/// Ours, then the other, round after round in this process: what else the machine does meets both
/// alike. The quicker one is repeated within a round until it has a tenth of the other's time. The
/// first round only warms up.
Turns take_turns(const Contender& ours,
                 const Contender& other,
                 ThreadPool& pool,
                 const TurnsConfig& config);

/// One alone, in the same way.
Timing time_alone(const Contender& work, ThreadPool& pool, const TurnsConfig& config);

}  // namespace semview::benchmark
