// SPDX-License-Identifier: Apache-2.0
/// From a camera's label image to the shape of a view profile.
#pragma once

#include <cstdint>
#include <variant>

#include "semview/core/result.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/geometry/pinhole_camera.hpp"
#include "semview/view/column_view.hpp"

namespace semview {

/// A spherical image that may show only a part of the surroundings. Its columns go from left to
/// right, its rows from top to bottom, in equal angles; a full turn is the default.
struct PartialPanorama {
  int columns = 0;
  int rows = 0;
  /// Left image edge, counter-clockwise from the robot's heading.
  double azimuth_left_rad = kPi;
  /// Right image edge, below the left one by at most 2π.
  double azimuth_right_rad = -kPi;
  double elevation_min_rad = -kPi / 4.0;  ///< lower image edge
  double elevation_max_rad = kPi / 4.0;   ///< upper image edge
  /// Where the camera stands in base_link; no part in resampling.
  Eigen::Vector3d position_m = {0.0, 0.0, 1.2};
};

/// A pinhole camera on the robot.
struct MountedPinhole {
  PinholeCamera camera;
  /// base_link from the camera's optical frame (x right, y down, z forward).
  Eigen::Isometry3d base_from_camera = Eigen::Isometry3d::Identity();
};

/// What took an observation's label image.
using ObservationCamera = std::variant<PartialPanorama, MountedPinhole>;

/// Where the camera stands, seen from above; see `Observation::base_from_eye`.
Pose2 base_from_eye(const ObservationCamera& camera);

/// @errors kInvalidArgument: sizes not in 1..20000, angles or intrinsics not finite or out of
/// order, focal lengths not above 0. `Error::field` names the member.
Status validate(const ObservationCamera& camera);

/// Resamples `labels`, taken by `camera`, to `profile` with the robot's heading in the middle.
///
/// A profile pixel gets the class of most source pixels whose centres fall into it (the lower id
/// among equals). Where none falls, it gets the source pixel that its own centre falls into, and
/// `kUnknown` where the camera did not look. `kNoHit` in the source counts as `kUnknown`: an
/// observation has no "nothing there"; `kUnknown` takes part in the majority.
///
/// Only directions count: that a camera stands off the robot's centre is the matter of
/// `Observation::base_from_eye`.
/// @param labels  As many rows and columns as `camera` says; `camera` must be valid.
/// @cost O(source pixels + profile pixels)
LabelImage resample(const LabelImage& labels,
                    const ObservationCamera& camera,
                    const PanoramaCamera& profile);

/// How sure one is of the labels that `resample` gives: the confidence of the source pixels of that
/// class, summed, over the number of all source pixels that fall into the profile pixel; 0 where
/// the label is unknown.
/// @param confidence  Of each of `labels`, 255 for certain; of their size.
/// @param resampled  What `resample` made of `labels`.
Image<std::uint8_t> resample_confidence(const Image<std::uint8_t>& confidence,
                                        const LabelImage& labels,
                                        const ObservationCamera& camera,
                                        const PanoramaCamera& profile,
                                        const LabelImage& resampled);

}  // namespace semview
