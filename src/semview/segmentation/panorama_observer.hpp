// SPDX-License-Identifier: Apache-2.0
/// From the photographs of a rig to one observation.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "semview/core/result.hpp"
#include "semview/segmentation/camera_rig.hpp"
#include "semview/segmentation/segmenter.hpp"
#include "semview/view/observation.hpp"

namespace semview::segmentation {

/// A full turn of labels, its rows cut to those that some camera shows.
struct ObservedPanorama {
  PartialPanorama camera;
  Segmentation segmentation;
  RgbImage photo;  ///< the photographs, stitched the same way; empty of labels made elsewhere

  /// As the reader of an observation folder would make it.
  Observation observation(const ClassTable& classes,
                          double stamp_s,
                          const PanoramaCamera& profile) const;
};

struct PanoramaObserverConfig {
  int columns = 720;  ///< of the full turn; rows are as high as columns are wide
};
inline constexpr int kMaxObservedColumns = 7200;

/// @errors kInvalidArgument: columns outside 4..kMaxObservedColumns; `Error::field` names it.
Status validate(const PanoramaObserverConfig& config);

/// Called before each picture that the network is shown; `done` of `total`.
using NetworkProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Segments each photograph (wide ones in crops) and stitches the labels.
/// @param photos  one a camera of `rig`, in its order
/// @errors kInvalidArgument: another number or size of photographs, or none shows anything; those
/// of `Segmenter::segment`.
Result<ObservedPanorama> observe(Segmenter& segmenter,
                                 const CameraRig& rig,
                                 std::span<const RgbImage> photos,
                                 const PanoramaObserverConfig& config = {},
                                 const NetworkProgress& progress = {});

/// The same of labels that another program has made: sure where they are known.
Result<ObservedPanorama> observe_labels(const CameraRig& rig,
                                        std::span<const LabelImage> labels,
                                        const PanoramaObserverConfig& config = {});

}  // namespace semview::segmentation
