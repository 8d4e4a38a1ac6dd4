// SPDX-License-Identifier: Apache-2.0
/// What one method did on one row, in a handful of numbers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "results.hpp"

namespace semview::paper2017 {

/// Over runs and stops. NaN where a method does not tell: another program has no particles.
struct Summary {
  std::size_t drives = 0;
  double best_m = 0.0;           ///< mean error of the particle of highest weight
  double estimate_m = 0.0;       ///< of the method's own estimate
  double weighted_mean_m = 0.0;  ///< mean distance of the particles, by weight
  double mean_m = 0.0;           ///< mean distance of the particles
  double min_m = 0.0;            ///< of the nearest particle
  double odometry_m = 0.0;
  double above_0_3_m = 0.0;  ///< share of stops whose estimate is further off
  double above_1_m = 0.0;
  std::optional<double> localized_from;  ///< median image of the drives that are localized
  double localized_by_three = 0.0;       ///< share of the drives
  double never_localized = 0.0;
};

/// None without drives.
std::optional<Summary> summary_of(const Results& results,
                                  std::string_view row,
                                  std::string_view method,
                                  Start start);

/// A line a row and method with all of the summary, in Markdown.
std::string summary_table(const Results& results, Start start);

}  // namespace semview::paper2017
