// SPDX-License-Identifier: Apache-2.0
/// The motion model of Neubert et al. 2017: odometry plus the same position noise at every step.
#pragma once

#include "semview/core/result.hpp"
#include "semview/localization/motion_model.hpp"

namespace semview::localization {

/// The paper prints σ only; the heading's noise is our choice.
struct PositionNoiseConfig {
  /// σ of x and of y a filter step, m; >= 0. The paper's 0.5 m belongs to its 14 stops, metres
  /// apart, on distorted maps.
  double sigma_m = 0.5;
  double heading_sigma_rad = kPi / 90.0;  ///< σ of the yaw a filter step; >= 0
  /// Added to σ for each metre of the step; >= 0. 0 is the paper's noise.
  double sigma_per_m = 0.0;
};

/// @errors kInvalidArgument: a parameter is negative or not finite; `Error::field` names it.
Status validate(const PositionNoiseConfig& config);

/// x and y each get N(0, (σ + σ_per_m · length)²), in the map's axes.
/// @source Neubert et al. 2017, section IV-A.1.
class PositionNoiseModel final : public MotionModel {
 public:
  /// `config` must be valid.
  explicit PositionNoiseModel(const PositionNoiseConfig& config) : config_(config) {}

  Pose2 sample(const Pose2& map_from_before,
               const Pose2& before_from_after,
               Rng& rng) const override;

 private:
  PositionNoiseConfig config_;
};

}  // namespace semview::localization
