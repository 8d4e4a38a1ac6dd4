// SPDX-License-Identifier: Apache-2.0
/// The odometry motion model of Probabilistic Robotics, with AMCL's parameters.
#pragma once

#include "semview/core/result.hpp"
#include "semview/localization/motion_model.hpp"

namespace semview::localization {

/// Variances of the three parts of a step: rotation 1, translation, rotation 2.
///
/// As in AMCL the parameters scale squares: the variance of a rotation φ over a way d is
/// alpha1·φ² + alpha2·d², that of the way alpha3·d² + alpha4·(φ₁² + φ₂²). AMCL's default is 0.2
/// for all, made for wheels and updates every 0.2 m; ours are smaller (docs/localization.md).
struct OdometryMotionConfig {
  double alpha1 = 0.02;   ///< rotation from rotation; >= 0
  double alpha2 = 0.005;  ///< rotation from translation, rad²/m²; >= 0
  double alpha3 = 0.02;   ///< translation from translation; >= 0
  double alpha4 = 0.005;  ///< translation from rotation, m²/rad²; >= 0
};

/// @errors kInvalidArgument: a parameter is negative or not finite; `Error::field` names it.
Status validate(const OdometryMotionConfig& config);

/// @source Thrun, Burgard, Fox 2005, table 5.6 (sample_motion_model_odometry), with AMCL's two
/// refinements: a step shorter than 1 cm has no direction, so its first rotation is 0; driving
/// backwards is not a half turn for the noise.
class OdometryMotionModel final : public MotionModel {
 public:
  /// `config` must be valid.
  explicit OdometryMotionModel(const OdometryMotionConfig& config) : config_(config) {}

  Pose2 sample(const Pose2& map_from_before,
               const Pose2& before_from_after,
               Rng& rng) const override;

 private:
  OdometryMotionConfig config_;
};

}  // namespace semview::localization
