// SPDX-License-Identifier: Apache-2.0
/// Cameras and how they are mounted, as YAML: what observation folders, run logs and camera rigs
/// write alike. See docs/formats/observation.md.
#pragma once

#include <Eigen/Geometry>

#include "semview/core/result.hpp"
#include "semview/io/yaml_document.hpp"
#include "semview/view/observation_resampler.hpp"

namespace semview::io {

/// The key `base_from_camera`: with all angles 0 the camera looks along x of base_link with z up.
/// The rotation is yaw about z, then pitch about the new y, then roll about the new x.
struct CameraMount {
  Eigen::Vector3d position_m = {0.0, 0.0, 1.2};
  double roll_rad = 0.0;
  double pitch_rad = 0.0;  ///< positive looks down
  double yaw_rad = 0.0;
};

/// base_link from the axes of a camera that looks along x with z up.
Eigen::Isometry3d base_from_level(const CameraMount& mount);
/// base_link from the optical frame (x right, y down, z forward).
Eigen::Isometry3d base_from_optical(const CameraMount& mount);
/// The mount of which `base_from_camera` is the `base_from_optical`.
CameraMount mount_of(const Eigen::Isometry3d& base_from_camera);

/// The value of `base_from_camera` in `owner`, or the default.
/// @errors kInvalidArgument with file and line; the same of the two below.
Result<CameraMount> parse_mount(const YamlNode& owner);

/// The value of `panorama`: its angles. Size and position come from elsewhere.
Result<PartialPanorama> parse_panorama(const YamlNode& node);

/// The value of `pinhole`.
Result<PinholeCamera> parse_pinhole(const YamlNode& node);

}  // namespace semview::io
