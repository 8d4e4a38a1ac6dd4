// SPDX-License-Identifier: Apache-2.0
/// How a real lens bends the straight rays of a pinhole camera.
#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "semview/core/result.hpp"

namespace semview {

/// A lens between a direction in the optical frame (x right, y down, z forward) and a point of the
/// image plane at z = 1, where a lens without distortion has (x/z, y/z).
///
/// @source The models are those of OpenCV and ROS: `plumb_bob` is Brown's (1966), `equidistant`
/// that of Kannala and Brandt (2006).
class Lens {
 public:
  enum class Model {
    kNone,
    kPlumbBob,     ///< coefficients k1, k2, p1, p2, k3
    kEquidistant,  ///< fisheye: coefficients k1, k2, k3, k4
  };
  using Coefficients = std::array<double, 5>;

  /// No distortion.
  Lens() = default;
  /// Coefficients that the model does not have are left out of account.
  /// @errors kInvalidArgument: a coefficient that is not finite or beyond 1000.
  static Result<Lens> make(Model model, const Coefficients& coefficients);

  Model model() const { return model_; }
  const Coefficients& coefficients() const { return k_; }

  /// Where a direction is seen; none behind the camera, and none so far off the axis that the
  /// polynomial has turned back: there it would show the same point a second time.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& direction) const;

  /// The unit direction that is seen at a point: the inverse of `project`. None where there is
  /// none.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& point) const;

  bool operator==(const Lens&) const = default;

 private:
  Eigen::Vector2d distort_plumb_bob(const Eigen::Vector2d& straight) const;
  std::optional<Eigen::Vector2d> undistort_plumb_bob(const Eigen::Vector2d& point) const;

  Model model_ = Model::kNone;
  Coefficients k_{};
  /// Of `kPlumbBob` the radius x²+y² at z = 1, of `kEquidistant` the angle off the axis, up to
  /// which the distorted radius grows.
  double limit_ = 0.0;
};

}  // namespace semview
