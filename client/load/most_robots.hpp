// SPDX-License-Identifier: Apache-2.0
/// How many robots a server holds.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "client/load/load_report.hpp"
#include "client/load/open_loop.hpp"
#include "semview/core/result.hpp"

namespace semview::client {

/// A server holds a load if at most one cycle in a hundred is late: refused, lost, or answered
/// later than a robot has use for it. Fewer than `kFewestCycles` cannot tell.
bool holds(const LoadReport& report);

inline constexpr std::size_t kFewestCycles = 100;

/// The fewest robots whose runs have `kFewestCycles`.
/// @errors kInvalidArgument, field `--seconds`: a robot has no time for one whole cycle.
Result<std::size_t> fewest_robots(const LoadConfig& config);

struct LoadStep {
  std::size_t robots = 0;
  LoadReport report;
};

struct MostRobots {
  std::size_t robots = 0;       ///< the most that were held; 0: not even `fewest`
  bool settled = false;         ///< no more than a twentieth above `robots` is left untried
  std::vector<LoadStep> steps;  ///< in the order in which they were tried
};

/// Doubles or halves from `first` until the limit is between two numbers, then halves the gap until
/// it is a twentieth; `kMaxSearchSteps` runs at most, of `fewest` to `most` robots.
/// @param run  Loads the server with so many robots.
/// @param time_left  Asked before each run but the first; false ends the search.
/// @errors those of `run`
Result<MostRobots> find_most_robots(std::size_t fewest,
                                    std::size_t first,
                                    std::size_t most,
                                    const std::function<Result<LoadReport>(std::size_t)>& run,
                                    const std::function<bool()>& time_left);

inline constexpr std::size_t kMaxSearchSteps = 16;

}  // namespace semview::client
