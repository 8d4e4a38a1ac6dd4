// SPDX-License-Identifier: Apache-2.0
/// What raised and what lowered a score, pixel by pixel and class by class.
#pragma once

#include <cstdint>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/column_view.hpp"
#include "semview/view/observation.hpp"

namespace semview::similarity {

/// What the observed pixels of one class add to a score, or those of them where the map's view has
/// one class.
struct ClassContribution {
  ClassId observed = kUnknown;
  ClassId map = kNoHit;  ///< `kNoHit` is "none"; means nothing in a sum over the map's classes
  std::int32_t pixels = 0;
  std::int32_t sum = 0;

  bool operator==(const ClassContribution&) const = default;
};

/// The terms of equation (1)'s numerator as the integers that scores are made of: those of the
/// picture, of `pairs` and of `observed` all add up to `sum`.
struct ScoreExplanation {
  std::int32_t weight_scale = 1;
  std::int32_t observed_pixels = 0;
  std::int32_t sum = 0;               ///< that of `PreparedObservation::sum`
  LabelImage view;                    ///< the map's, turned to the heading
  Image<std::int32_t> contributions;  ///< a pixel; 0 where none was observed
  // Strongest first, whatever the sign; ties by ids.
  std::vector<ClassContribution> pairs;
  std::vector<ClassContribution> observed;

  /// The part of the similarity that a sum is.
  double similarity(std::int32_t part) const {
    return static_cast<double>(part) /
           (static_cast<double>(weight_scale) * static_cast<double>(observed_pixels));
  }
};

/// Compares the observation with a view of the map, turned to a heading of the PoseGrid.
/// @errors those of `PreparedObservation::build`; kInternal: a view of another shape or map.
Result<ScoreExplanation> explain_score(const Observation& observation,
                                       const WeightMatrix& weights,
                                       const ClassTable& map_classes,
                                       const PanoramaCamera& camera,
                                       const ColumnView& view,
                                       int heading);

}  // namespace semview::similarity
