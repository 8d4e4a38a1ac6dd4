// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/lost_probability.hpp"

#include <algorithm>
#include <cmath>

namespace semview::observation {
namespace {

constexpr double kLeastSigma_m = 0.01;
/// Observations that fit everywhere alike say nothing of the place.
constexpr double kLeastContrast = 1e-6;

double advantage(const PlaceScores& scores) {
  const double contrast =
      std::max({kLeastContrast, scores.elsewhere - scores.mean, scores.here - scores.mean});
  return std::clamp((scores.here - scores.elsewhere) / contrast, -1.0, 1.0);
}

}  // namespace

const LostModel& learned_lost_model() {
  static const LostModel kModel{1.0788, {-5.4217, -3.2036, -5.4218, 0.2376, -0.5812}};
  return kModel;
}

double lost_probability(const LostFeatures& features, const LostModel& model) {
  double logit = model.intercept;
  const auto values = features.values();
  for (std::size_t i = 0; i < values.size(); ++i) logit += model.weights[i] * values[i];
  return 1.0 / (1.0 + std::exp(-logit));
}

LostFeatures LostWatch::look(const PlaceScores& scores,
                             double mode_weight,
                             double sigma_m,
                             double effective_share) {
  LostFeatures features;
  features.advantage = advantage(scores);
  features.advantage_before = advantage_before_.value_or(features.advantage);
  features.mode_weight = mode_weight;
  features.log_sigma = std::log(std::max(kLeastSigma_m, sigma_m));
  features.log_effective_share = std::log(std::max(1e-6, effective_share));
  advantage_before_ = 0.5 * (features.advantage_before + features.advantage);
  return features;
}

}  // namespace semview::observation
