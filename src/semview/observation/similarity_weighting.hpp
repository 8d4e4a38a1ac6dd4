// SPDX-License-Identifier: Apache-2.0
/// From the similarity of two views to the weight of a particle.
#pragma once

#include "semview/core/result.hpp"

namespace semview::observation {

/// The 2017 paper does not print its transform; docs/localization.md tells why it must be sharp.
enum class WeightTransform {
  kPower,        ///< weight = max(similarity, 0)^power: negative similarities are 0, as printed
  kExponential,  ///< weight = exp(kappa · similarity): negative similarities stay apart
};

struct SimilarityWeightingConfig {
  WeightTransform transform = WeightTransform::kPower;
  double power = 20.0;  ///< p, > 0; 1 is plain proportionality
  double kappa = 60.0;  ///< κ, > 0
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const SimilarityWeightingConfig& config);

/// The logarithm of the weight; -∞ where the weight is 0.
double log_weight(const SimilarityWeightingConfig& config, double similarity);

}  // namespace semview::observation
