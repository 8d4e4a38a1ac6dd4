// SPDX-License-Identifier: Apache-2.0
/// From a network's coarse output to a label a pixel. For the sources of this module.
#pragma once

#include <span>

#include "semview/segmentation/segmentation_model.hpp"
#include "semview/segmentation/segmenter.hpp"

namespace semview::segmentation {

/// One plane of rows × columns a channel, one after the other.
struct ChannelPlanes {
  std::span<const float> values;
  int channels = 0;
  int rows = 0;
  int columns = 0;
};

/// Enlarges the planes bilinearly (pixel centres on pixel centres, edges repeated) to rows ×
/// columns and takes the best channel of each pixel; of equally good ones the first. Confidence is
/// the softmax over the channels of logits, else the value itself.
/// @param planes  of logits or probabilities: all finite, a channel a class
/// @cost O(rows · columns · channels)
Segmentation best_classes(const ChannelPlanes& planes,
                          const SegmentationModel& model,
                          int rows,
                          int columns);

}  // namespace semview::segmentation
