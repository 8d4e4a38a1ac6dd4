// SPDX-License-Identifier: Apache-2.0
/// How particles follow the robot's odometry.
#pragma once

#include "semview/core/random.hpp"
#include "semview/geometry/pose2.hpp"

namespace semview::localization {

/// Samples a pose after a step, given the pose before it: p(x_t | u_t, x_{t-1}).
///
/// A model is stateless: the same pose, step and state of `rng` give the same sample.
/// @threads safe to call from several threads with a generator each
class MotionModel {
 public:
  virtual ~MotionModel() = default;

  /// @param before_from_after  what odometry measured since the last filter step
  virtual Pose2 sample(const Pose2& map_from_before,
                       const Pose2& before_from_after,
                       Rng& rng) const = 0;
};

}  // namespace semview::localization
