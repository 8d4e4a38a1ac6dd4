// SPDX-License-Identifier: Apache-2.0
/// The interface of semantic segmentation: a class for every pixel of a camera image.
#pragma once

#include <cstdint>

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/view/column_view.hpp"

namespace semview::segmentation {

/// Labels and how sure one is of them, of equal size.
struct Segmentation {
  LabelImage labels;  ///< ids of the segmenter's classes, or `kUnknown`
  /// Probability of the label, 255 for 1. An unknown pixel has that of being none of the classes; 0
  /// where nothing was seen.
  Image<std::uint8_t> confidence;
};

/// Something that labels camera images, a network for example.
///
/// @threads for one thread at a time
class Segmenter {
 public:
  virtual ~Segmenter() = default;

  /// The vocabulary of the labels.
  virtual const ClassTable& classes() const = 0;

  /// @param image  Upright as far as the camera is; not empty.
  /// @return as many rows and columns as `image`
  /// @errors kInternal: the network failed; kFailedPrecondition: its output is not what its
  /// description says.
  virtual Result<Segmentation> segment(const RgbImage& image) = 0;
};

}  // namespace semview::segmentation
