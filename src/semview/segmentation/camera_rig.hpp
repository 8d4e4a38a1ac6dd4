// SPDX-License-Identifier: Apache-2.0
/// The cameras that together take one observation. See docs/formats/camera_rig.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/segmentation/rig_camera.hpp"

namespace semview::segmentation {

struct NamedCamera {
  std::string name;
  RigCamera camera;
};

/// Cameras in the order of their photographs.
struct CameraRig {
  std::vector<NamedCamera> cameras;

  /// Where the one eye stands that an observation has: the middle of the cameras, in base_link. A
  /// pan-tilt unit's cameras are a few centimetres apart, which is less than a cell of views.
  Eigen::Vector3d eye_m() const;
};

inline constexpr std::size_t kMaxRigCameras = 64;

/// Reads a rig.
/// @errors kNotFound: no such file; kInvalidArgument with file and line; kUnimplemented: a format
/// of later versions.
Result<CameraRig> read_camera_rig(const std::filesystem::path& path);

/// One level camera that writes photographs of the whole sphere, `height_m` above base_link.
CameraRig equirectangular_rig(double height_m);

/// The camera of an observation or run log, as a rig.
CameraRig rig_of(const ObservationCamera& camera);

}  // namespace semview::segmentation
