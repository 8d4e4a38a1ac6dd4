// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/similarity_weighting.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace semview::observation {
namespace {

Status check_positive(const char* field, double value) {
  constexpr double kMost = 1e6;  // far beyond it only the best particle has a weight
  if (value > 0.0 && value <= kMost) return {};
  return fail(Error{ErrorCode::kInvalidArgument,
                    fmt::format("{} is {}: expected a number > 0, at most {}", field, value, kMost),
                    field});
}

}  // namespace

Status validate(const SimilarityWeightingConfig& config) {
  SEMVIEW_TRY_STATUS(check_positive("power", config.power));
  return check_positive("kappa", config.kappa);
}

double log_weight(const SimilarityWeightingConfig& config, double similarity) {
  if (config.transform == WeightTransform::kExponential) return config.kappa * similarity;
  if (similarity <= 0.0) return -std::numeric_limits<double>::infinity();
  return config.power * std::log(similarity);
}

}  // namespace semview::observation
