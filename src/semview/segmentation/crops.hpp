// SPDX-License-Identifier: Apache-2.0
/// Perspective crops of photographs too wide for a network: it has learned from pictures whose
/// walls are straight and upright.
#pragma once

#include <vector>

#include "semview/segmentation/stitching.hpp"

namespace semview::segmentation {

inline constexpr int kCrops = 6;  ///< around the horizon, so that neighbours overlap by 40°
inline constexpr double kCropWidth_deg = 100.0;
inline constexpr int kCropSide_px = 512;

/// A part of a photograph as a level pinhole camera would have taken it.
struct Crop {
  Photo photo;
  Image<std::uint8_t> seen;  ///< 0 where the photograph does not show the direction
};

/// Whether a photograph is shown to the network in crops: one that is equirectangular, or whose
/// lens sees more than 60° off its axis.
bool is_too_wide(const RigCamera& camera);

/// `kCrops` square crops in equal turns from the robot's heading, level in base_link: the camera's
/// roll and pitch are undone in them already. Those that show nothing of the photograph are left
/// out.
std::vector<Crop> level_crops(const Photo& photo);

/// The colours of `photo` where `camera` looks, each pixel the mean of several samples where the
/// photograph is finer, bilinear between its pixels.
Crop crop(const Photo& photo, const LensCamera& camera);

}  // namespace semview::segmentation
