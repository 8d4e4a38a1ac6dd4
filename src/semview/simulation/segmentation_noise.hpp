// SPDX-License-Identifier: Apache-2.0
/// Labels that err as a segmentation network errs: in blobs and along edges, not pixel by pixel.
#pragma once

#include "semview/core/random.hpp"
#include "semview/view/column_view.hpp"

namespace semview::simulation {

struct SegmentationNoiseConfig {
  double edge_shift_rad =
      0.0175;                   ///< typical distance (1°) between a border as seen and as labelled
  double edge_wave_rad = 0.14;  ///< length over which a border swings from one side to the other
  double blobs_per_sr = 2.0;    ///< wrong patches a steradian
  double min_blob_rad = 0.05;   ///< half a patch's width
  double max_blob_rad = 0.20;
  double unknown_share = 0.15;    ///< of the patches: the network does not decide
  double elsewhere_share = 0.25;  ///< of the patches: a class that is not in the picture at all
};

/// How a label image divides the directions that it shows.
struct LabelGeometry {
  double column_rad = 0.0;  ///< azimuth of a column
  double row_rad = 0.0;     ///< elevation of a row
  bool full_turn = false;   ///< the last column is the first one's neighbour
};

/// `labels` (ids 1..`classes`, `kUnknown` stays) with errors. A patch covers only pixels of the
/// class in its middle, as a network confuses a part of one thing; all of it becomes one other
/// class. `level` scales the shifts and the number of patches: 0 leaves the labels as they are.
LabelImage add_segmentation_noise(const LabelImage& labels,
                                  const LabelGeometry& geometry,
                                  int classes,
                                  const SegmentationNoiseConfig& config,
                                  double level,
                                  Rng& rng);

}  // namespace semview::simulation
