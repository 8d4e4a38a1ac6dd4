// SPDX-License-Identifier: Apache-2.0
#include "semview/evaluation/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "semview/core/check.hpp"

namespace semview::evaluation {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

double quantile_of_sorted(std::span<const double> sorted, double probability) {
  const double place = probability * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - std::floor(place)) * (sorted[above] - sorted[below]);
}

std::vector<double> sorted(std::span<const double> values) {
  std::vector<double> copy(values.begin(), values.end());
  std::ranges::sort(copy);
  return copy;
}

}  // namespace

double mean(std::span<const double> values) {
  if (values.empty()) return kNothing;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double quantile(std::span<const double> values, double probability) {
  SEMVIEW_ASSERT(probability >= 0.0 && probability <= 1.0);
  return values.empty() ? kNothing : quantile_of_sorted(sorted(values), probability);
}

double median(std::span<const double> values) { return quantile(values, 0.5); }

double share_above(std::span<const double> values, double limit) {
  if (values.empty()) return kNothing;
  const auto above = std::ranges::count_if(values, [&](double value) { return value > limit; });
  return static_cast<double>(above) / static_cast<double>(values.size());
}

Interval bootstrap_mean(std::span<const double> values, double level, std::size_t draws, Rng& rng) {
  if (values.empty()) return {kNothing, kNothing};
  std::vector<double> means(std::max<std::size_t>(draws, 1));
  for (double& one : means) {
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += values[rng.below(values.size())];
    one = sum / static_cast<double>(values.size());
  }
  std::ranges::sort(means);
  const double tail = (1.0 - level) / 2.0;
  return {quantile_of_sorted(means, tail), quantile_of_sorted(means, 1.0 - tail)};
}

BoxSummary box_summary(std::span<const double> values) {
  SEMVIEW_CHECK(!values.empty());
  const std::vector<double> all = sorted(values);
  BoxSummary box;
  box.low_quartile = quantile_of_sorted(all, 0.25);
  box.median = quantile_of_sorted(all, 0.5);
  box.high_quartile = quantile_of_sorted(all, 0.75);
  const double reach = 1.5 * (box.high_quartile - box.low_quartile);
  box.low_whisker = box.low_quartile;
  box.high_whisker = box.high_quartile;
  for (const double value : all) {
    if (value < box.low_quartile - reach || value > box.high_quartile + reach) {
      box.outliers.push_back(value);
    } else {
      box.low_whisker = std::min(box.low_whisker, value);
      box.high_whisker = std::max(box.high_whisker, value);
    }
  }
  return box;
}

}  // namespace semview::evaluation
