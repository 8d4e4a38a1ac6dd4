// SPDX-License-Identifier: Apache-2.0
/// Am I lost? A calibrated probability that the reported place is wrong.
#pragma once

#include <array>
#include <optional>

#include "semview/observation/place_probe.hpp"

namespace semview::observation {

/// What tells a robot that it is not where it believes to be. All are relative to what the same
/// observation says of other places, or to the belief itself: none depends on how noisy the
/// segmentation is or on the scale of the weights.
struct LostFeatures {
  /// By how much the best place near the reported one fits better than the best one elsewhere, in
  /// units of how far the better of both stands out from the mean of all places; in [-1, 1].
  double advantage = 0.0;
  double advantage_before = 0.0;     ///< mean over the frames before, the last counts half
  double mode_weight = 0.0;          ///< share of the belief that the estimate speaks for
  double log_sigma = 0.0;            ///< ln of the long half axis of its ellipse, m; at least 1 cm
  double log_effective_share = 0.0;  ///< ln of N_eff / N

  static constexpr std::size_t kCount = 5;
  std::array<double, kCount> values() const {
    return {advantage, advantage_before, mode_weight, log_sigma, log_effective_share};
  }
};

/// Logistic regression: P(lost) = 1 / (1 + exp(-(intercept + Σ weight · feature))).
struct LostModel {
  double intercept = 0.0;
  std::array<double, LostFeatures::kCount> weights{};
};

/// Learned on worlds 101 to 106 of experiments/paper2017, where lost means more than 1 m off
/// (docs/localization.md#am-i-lost).
const LostModel& learned_lost_model();

double lost_probability(const LostFeatures& features,
                        const LostModel& model = learned_lost_model());

/// Makes features frame by frame.
class LostWatch {
 public:
  LostFeatures look(const PlaceScores& scores,
                    double mode_weight,
                    double sigma_m,
                    double effective_share);

 private:
  std::optional<double> advantage_before_;
};

}  // namespace semview::observation
