// SPDX-License-Identifier: Apache-2.0
#include "client/load/most_robots.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace semview::client {

bool holds(const LoadReport& report) {
  return report.cycles >= kFewestCycles && 100 * report.in_time >= 99 * report.cycles;
}

Result<std::size_t> fewest_robots(const LoadConfig& config) {
  if (config.seconds * config.rate_hz >= 1.0) {
    // Counted as a run counts them, so that rounding loses none.
    for (std::size_t robots = 1;; ++robots) {
      const double total_hz = config.rate_hz * static_cast<double>(robots);
      if (config.seconds * total_hz >= kFewestCycles) return robots;
    }
  }
  return fail(Error{ErrorCode::kInvalidArgument,
                    fmt::format("--seconds {:g}: a robot has no time for a cycle; a search needs "
                                "at least {:g} s at --rate {:g}",
                                config.seconds,
                                1.0 / config.rate_hz,
                                config.rate_hz),
                    "--seconds"});
}

Result<MostRobots> find_most_robots(std::size_t fewest,
                                    std::size_t first,
                                    std::size_t most,
                                    const std::function<Result<LoadReport>(std::size_t)>& run,
                                    const std::function<bool()>& time_left) {
  MostRobots found;
  std::size_t too_many = most + 1;
  std::size_t next = std::clamp(first, fewest, most);
  while (found.steps.size() < kMaxSearchSteps && (found.steps.empty() || time_left())) {
    SEMVIEW_TRY(const LoadReport report, run(next));
    found.steps.push_back({next, report});
    (holds(report) ? found.robots : too_many) = next;
    const std::size_t untried_above = std::max(found.robots, fewest - 1);
    found.settled = too_many - untried_above <= std::max<std::size_t>(1, found.robots / 20);
    if (found.settled) break;
    if (found.robots == 0) {
      next = std::max(too_many / 2, fewest);
    } else if (too_many > most) {
      next = std::min(2 * found.robots, most);
    } else {
      next = (found.robots + too_many) / 2;
    }
  }
  return found;
}

}  // namespace semview::client
