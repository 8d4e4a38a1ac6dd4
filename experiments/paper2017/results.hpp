// SPDX-License-Identifier: Apache-2.0
/// The experiment's drives, looked up by row, method and start.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment.hpp"
#include "semview/evaluation/statistics.hpp"

namespace semview::paper2017 {

using Field = double StopRecord::*;

/// Looks at an experiment, which must outlive it.
class Results {
 public:
  explicit Results(const Experiment& experiment) : experiment_(experiment) {}

  const Experiment& experiment() const { return experiment_; }

  /// Of one world, in order of runs.
  std::vector<const TrialRecord*> drives(std::string_view row,
                                         std::string_view method,
                                         Start start,
                                         std::uint64_t world) const;

  /// A field over all drives and stops, by worlds, runs, stops; empty if there are no drives.
  std::vector<double> values(std::string_view row,
                             std::string_view method,
                             Start start,
                             Field field) const;
  /// The same at one stop, counted from 1.
  std::vector<double> values_at(
      std::string_view row, std::string_view method, Start start, Field field, int stop) const;
  /// Means over runs and stops, one a world that has drives.
  std::vector<double> world_means(std::string_view row,
                                  std::string_view method,
                                  Start start,
                                  Field field) const;

  /// Methods with drives of that start, in the order of `all_methods()`, then others by name.
  std::vector<std::string> methods(Start start) const;

 private:
  const Experiment& experiment_;
};

/// 95 % of where the mean over worlds might lie, by 10 000 draws of a fixed seed. None below two
/// worlds: all draws would be the same, an interval of no width.
std::optional<evaluation::Interval> interval_over_worlds(const std::vector<double>& world_means);

/// "0.041–0.086", or "-" where there is none.
std::string to_text(const std::optional<evaluation::Interval>& interval);

/// The image, from 1, from which on all errors are below `limit_m`; none if the last is not.
std::optional<int> localized_from(const TrialRecord& drive, double limit_m);

inline constexpr double kLocalizedWithin_m = 0.5;

}  // namespace semview::paper2017
