// SPDX-License-Identifier: Apache-2.0
/// One camera of a rig: which pixel of its photograph shows a direction.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include <Eigen/Geometry>

#include "semview/geometry/lens.hpp"
#include "semview/geometry/pinhole_camera.hpp"
#include "semview/view/observation_resampler.hpp"

namespace semview::segmentation {

/// A camera with a lens; `pinhole` are the intrinsics of its undistorted rays.
struct LensCamera {
  PinholeCamera pinhole;
  Lens lens;
  /// base_link from the optical frame (x right, y down, z forward).
  Eigen::Isometry3d base_from_camera = Eigen::Isometry3d::Identity();
};

/// A camera that writes equirectangular photographs.
struct EquirectangularCamera {
  /// Angles of the photograph in the camera's own frame; its position has no meaning here. Rows and
  /// columns are those of the photograph at hand.
  PartialPanorama photo;
  /// base_link from the camera's frame (x to where its azimuth is 0, z up).
  Eigen::Isometry3d base_from_camera = Eigen::Isometry3d::Identity();
};

using RigCamera = std::variant<LensCamera, EquirectangularCamera>;

int rows_of(const RigCamera& camera);
int columns_of(const RigCamera& camera);
const Eigen::Isometry3d& base_from(const RigCamera& camera);

/// The camera for a photograph of rows × columns.
/// @errors kInvalidArgument: a lens camera of another size.
Result<RigCamera> of_size(const RigCamera& camera, int rows, int columns);

/// Where a photograph shows `direction` of base_link: (u, v) from its upper-left corner, within it.
/// Only directions count; the camera's position does not.
std::optional<Eigen::Vector2d> pixel_of(const RigCamera& camera, const Eigen::Vector3d& direction);

/// How far (u, v) is from the nearest image border, 1 for the middle of the shorter side and 0 for
/// the border itself. A full turn has no border to the left and right.
double distance_to_border(const RigCamera& camera, const Eigen::Vector2d& pixel);

/// The angle off its axis up to which a lens camera sees, along its rows and columns; π of a
/// photograph that is none.
double widest_half_angle_rad(const RigCamera& camera);

}  // namespace semview::segmentation
