// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/cell_posterior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace semview::observation {

double cell_log_weight(const SimilarityWeightingConfig& config,
                       std::span<const double> similarities) {
  // Relative to the highest weight: powers of small similarities leave the range of doubles.
  const double highest = log_weight(config, *std::ranges::max_element(similarities));
  if (!std::isfinite(highest)) return -std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (const double similarity : similarities) {
    sum += std::exp(log_weight(config, similarity) - highest);
  }
  return highest + std::log(sum);
}

Result<std::vector<float>> cell_probabilities(std::span<const double> log_weights) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const double log_weight : log_weights) {
    if (log_weight > highest) highest = log_weight;  // false for NaN
  }
  if (!std::isfinite(highest)) {
    return fail(ErrorCode::kFailedPrecondition,
                "the observation is possible nowhere: no cell has a similarity above 0");
  }
  double total = 0.0;
  for (const double log_weight : log_weights) {
    if (!std::isnan(log_weight)) total += std::exp(log_weight - highest);
  }
  std::vector<float> probabilities;
  probabilities.reserve(log_weights.size());
  for (const double log_weight : log_weights) {
    probabilities.push_back(static_cast<float>(std::exp(log_weight - highest) / total));
  }
  return probabilities;
}

}  // namespace semview::observation
