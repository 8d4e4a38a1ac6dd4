// SPDX-License-Identifier: Apache-2.0
/// How a segmentation network errs on the experiment's views: in whole objects, in patches, along
/// borders; hardly ever pixel by pixel.
#pragma once

#include <cstdint>

#include "scene.hpp"

namespace semview::paper2017 {

/// Errors of level 1, and the level that was chosen: docs/reproduction.md tells how.
struct LabelNoiseConfig {
  double object_error = 0.5;  ///< share of objects called something else; half of these always,
                              ///< half in single views
  double patch_share = 0.09;  ///< of the pixels of walls, floor and ceiling
  double patch_rad = 0.16;    ///< typical size of a patch
  double border_shift_rad = 0.0157;  ///< σ of how far off a border is
  double border_wave_rad = 0.10;     ///< length over which that changes
  double salt_share = 0.01;          ///< single pixels
  double level = 0.2;                ///< scales all shares and shifts; 0: no error
};

/// The labels that a network gives for what `view` truly shows.
///
/// @param pixel_rad  angle of a pixel
/// @param world_seed  decides which objects are always mistaken, and for what
/// @param view_seed   decides everything else
LabelImage misread(const SceneView& view,
                   double pixel_rad,
                   const LabelNoiseConfig& config,
                   std::uint64_t world_seed,
                   std::uint64_t view_seed);

}  // namespace semview::paper2017
