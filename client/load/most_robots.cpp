// SPDX-License-Identifier: Apache-2.0
#include "client/load/most_robots.hpp"

#include <algorithm>

namespace semview::client {

bool holds(const LoadReport& report) { return 100 * report.in_time >= 99 * report.cycles; }

Result<MostRobots> find_most_robots(std::size_t first,
                                    std::size_t most,
                                    const std::function<Result<LoadReport>(std::size_t)>& run,
                                    const std::function<bool()>& time_left) {
  MostRobots found;
  std::size_t too_many = most + 1;
  std::size_t next = std::clamp<std::size_t>(first, 1, most);
  while (found.steps.size() < kMaxSearchSteps && (found.steps.empty() || time_left())) {
    SEMVIEW_TRY(const LoadReport report, run(next));
    found.steps.push_back({next, report});
    (holds(report) ? found.robots : too_many) = next;
    found.settled = too_many - found.robots <= std::max<std::size_t>(1, found.robots / 20);
    if (found.settled) break;
    if (found.robots == 0) {
      next = too_many / 2;
    } else if (too_many > most) {
      next = std::min(2 * found.robots, most);
    } else {
      next = (found.robots + too_many) / 2;
    }
  }
  return found;
}

}  // namespace semview::client
