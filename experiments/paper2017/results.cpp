// SPDX-License-Identifier: Apache-2.0
#include "results.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "semview/core/random.hpp"

namespace semview::paper2017 {

std::vector<const TrialRecord*> Results::drives(std::string_view row,
                                                std::string_view method,
                                                Start start,
                                                std::uint64_t world) const {
  std::vector<const TrialRecord*> found;
  for (const TrialRecord& trial : experiment_.trials) {
    if (trial.row == row && trial.method == method && trial.start == start &&
        trial.world == world) {
      found.push_back(&trial);
    }
  }
  return found;
}

std::vector<double> Results::values(std::string_view row,
                                    std::string_view method,
                                    Start start,
                                    Field field) const {
  std::vector<double> values;
  for (const TrialRecord& trial : experiment_.trials) {
    if (trial.row != row || trial.method != method || trial.start != start) continue;
    for (const StopRecord& stop : trial.stops) values.push_back(stop.*field);
  }
  return values;
}

std::vector<double> Results::values_at(
    std::string_view row, std::string_view method, Start start, Field field, int at) const {
  std::vector<double> values;
  for (const TrialRecord& trial : experiment_.trials) {
    if (trial.row != row || trial.method != method || trial.start != start) continue;
    for (const StopRecord& stop : trial.stops) {
      if (stop.stop == at) values.push_back(stop.*field);
    }
  }
  return values;
}

std::vector<double> Results::world_means(std::string_view row,
                                         std::string_view method,
                                         Start start,
                                         Field field) const {
  std::vector<double> means;
  for (const std::uint64_t world : experiment_.config.worlds) {
    std::vector<double> values;
    for (const TrialRecord* drive : drives(row, method, start, world)) {
      for (const StopRecord& stop : drive->stops) values.push_back(stop.*field);
    }
    if (!values.empty()) means.push_back(evaluation::mean(values));
  }
  return means;
}

std::vector<std::string> Results::methods(Start start) const {
  std::set<std::string> seen;
  for (const TrialRecord& trial : experiment_.trials) {
    if (trial.start == start) seen.insert(trial.method);
  }
  std::vector<std::string> ordered;
  for (const Method& method : all_methods()) {
    if (seen.erase(method.id) > 0) ordered.push_back(method.id);
  }
  ordered.insert(ordered.end(), seen.begin(), seen.end());
  return ordered;
}

std::optional<evaluation::Interval> interval_over_worlds(const std::vector<double>& world_means) {
  if (world_means.size() < 2) return std::nullopt;
  constexpr double kLevel = 0.95;
  constexpr std::size_t kDraws = 10'000;
  Rng rng(1, "bootstrap over worlds");
  return evaluation::bootstrap_mean(world_means, kLevel, kDraws, rng);
}

std::string to_text(const std::optional<evaluation::Interval>& interval) {
  return interval ? fmt::format("{:.3f}–{:.3f}", interval->low, interval->high) : "-";
}

std::optional<int> localized_from(const TrialRecord& drive, double limit_m) {
  std::optional<int> from;
  for (const StopRecord& stop : drive.stops) {
    if (!(stop.estimate_m < limit_m)) {
      from.reset();
    } else if (!from) {
      from = stop.stop;
    }
  }
  return from;
}

}  // namespace semview::paper2017
