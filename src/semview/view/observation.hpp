// SPDX-License-Identifier: Apache-2.0
/// What a robot's camera saw, in labels, in the shape of a view profile.
#pragma once

#include <cstdint>
#include <optional>

#include "semview/geometry/pose2.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/view/column_view.hpp"
#include "semview/view/voxel_list.hpp"

namespace semview {

/// A label panorama with the robot's heading in the middle. Its reader has resampled it to the view
/// profile's columns × rows; a pixel that the camera did not see is `kUnknown`, and so is one whose
/// file says 0: an observation has no "nothing there".
struct Observation {
  ClassTable classes;  ///< the observer's own vocabulary, not the map's
  LabelImage labels;   ///< ids of `classes`, or `kUnknown`
  double stamp_s = 0.0;
  /// Where the camera stands on the robot: yaw 0, since `labels` are turned to the heading. A robot
  /// at `map_from_base` is scored at `map_from_base * base_from_eye`.
  Pose2 base_from_eye = {};
  /// How sure the network was of each label, 255 for certain; empty where nobody said. No score
  /// uses it yet.
  Image<std::uint8_t> confidence = {};
  /// What a depth camera saw, for sources that score it; those that compare views do not look here.
  /// Of frame `base`: `base_from_eye` is the identity where there is no panorama beside it.
  std::optional<VoxelList> voxels = {};
};

}  // namespace semview
