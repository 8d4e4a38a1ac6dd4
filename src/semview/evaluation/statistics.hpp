// SPDX-License-Identifier: Apache-2.0
/// What a handful of numbers says, and how sure that is.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "semview/core/random.hpp"

namespace semview::evaluation {

/// NaN of no values.
double mean(std::span<const double> values);

/// The value below which the share `probability` in [0, 1] of the values lies, linear between
/// neighbours (Hyndman, Fan 1996, type 7, as numpy and R have it); NaN of no values.
double quantile(std::span<const double> values, double probability);

double median(std::span<const double> values);

/// The share of the values above `limit`; NaN of no values.
double share_above(std::span<const double> values, double limit);

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// Where the mean would lie had other values of the same kind been drawn: the percentile interval
/// of `draws` means of as many values, drawn with replacement. One value gives itself, none NaN.
/// @param level  for example 0.95
/// @source Efron, Tibshirani 1993, section 13.3
Interval bootstrap_mean(std::span<const double> values, double level, std::size_t draws, Rng& rng);

/// A box plot's numbers (Tukey): whiskers reach to the last value within 1.5 box heights.
struct BoxSummary {
  double low_whisker = 0.0;
  double low_quartile = 0.0;
  double median = 0.0;
  double high_quartile = 0.0;
  double high_whisker = 0.0;
  std::vector<double> outliers;  ///< beyond the whiskers, rising
};

/// @param values  not empty
BoxSummary box_summary(std::span<const double> values);

}  // namespace semview::evaluation
