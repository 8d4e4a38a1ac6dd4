// SPDX-License-Identifier: Apache-2.0
/// A depth image with labels, counted into voxels of the robot's own frame.
#pragma once

#include <cstdint>
#include <vector>

#include "semview/semantics/class_table.hpp"

namespace semview {

/// Voxel (x, y, z) covers [x·v, (x+1)·v) × … of frame `base`, v the list's `voxel_m`.
struct ObservedVoxel {
  std::int16_t x = 0;
  std::int16_t y = 0;
  std::int16_t z = 0;
  ClassId label = kUnknown;  ///< of the list's classes, or `kUnknown`
  std::uint32_t count = 0;   ///< pixels of this class whose points lie in the voxel

  bool operator==(const ObservedVoxel&) const = default;
};

/// All that the likelihood of the 2023 paper needs of an observation: while the robot stays on its
/// floor, a voxel's layer z is the same at every pose, and only x and y are left to turn.
struct VoxelList {
  ClassTable classes;  ///< the observer's own vocabulary, not the map's
  double voxel_m = 0.05;
  std::vector<ObservedVoxel> voxels;  ///< by (label, z, y, x), each once
  double stamp_s = 0.0;

  bool operator==(const VoxelList&) const = default;
};

}  // namespace semview
