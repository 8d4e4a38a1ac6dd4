// SPDX-License-Identifier: Apache-2.0
/// Who names what the camera sees: nobody errs, or a detector of objects does.
#pragma once

#include <cstdint>
#include <string_view>

#include "rgbd_camera.hpp"

namespace semview::paper2023 {

enum class LabelSource {
  kGt,        ///< every object as it is called; walls, floor and ceiling unknown
  kRcnnLike,  ///< as Mask R-CNN: misses objects, takes some for others, draws loose borders
};

/// "gt" or "rcnn".
std::string_view name(LabelSource source);

/// Half of the misses and of the mistakes befall an object in every view of it, half in single
/// views.
struct DetectorConfig {
  double missed = 0.15;           ///< share of objects that are unknown in a view
  double mistaken = 0.08;         ///< share of the others that are called something else
  double border_at_640_px = 4.0;  ///< σ of how far off borders are, in an image 640 wide
  double wave_at_640_px = 40.0;   ///< length over which that changes
};

/// Ids of `thing_classes()`, or `kUnknown`.
LabelImage true_labels(const RgbdTruth& truth);

/// @param always_seed  decides which objects are always missed or mistaken
/// @param view_seed    decides everything else
LabelImage detect(const RgbdTruth& truth,
                  const DetectorConfig& config,
                  std::uint64_t always_seed,
                  std::uint64_t view_seed);

}  // namespace semview::paper2023
