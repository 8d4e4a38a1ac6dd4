// SPDX-License-Identifier: Apache-2.0
/// The posterior of a floor cell by cell: what `DensePosterior` says of all headings of a cell
/// together, with one number a cell in memory in place of 120.
#pragma once

#include <span>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/observation/similarity_weighting.hpp"

namespace semview::observation {

/// The logarithm of the sum of the weights of a cell's headings; -∞ if none is possible.
double cell_log_weight(const SimilarityWeightingConfig& config,
                       std::span<const double> similarities);

/// That the eye was in each cell, whatever its heading: weights over the sum of all of them.
/// @param log_weights  Of `cell_log_weight`; NaN, a cell that is not asked about or has no view,
/// stays NaN. The sum is taken in this order.
/// @errors kFailedPrecondition: no cell is possible.
Result<std::vector<float>> cell_probabilities(std::span<const double> log_weights);

}  // namespace semview::observation
