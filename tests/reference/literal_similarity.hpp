// SPDX-License-Identifier: Apache-2.0
/// Equation (1) of Neubert et al. 2017 pixel by pixel: slow and obvious, to compare with.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "semview/geometry/panorama_camera.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/column_view.hpp"
#include "semview/view/observation.hpp"

namespace semview::reference {

/// w of an observed and a map class at an elevation, both by name.
inline double literal_weight(const similarity::WeightMatrix& weights,
                             double elevation_deg,
                             std::string_view observed,
                             std::string_view map) {
  const auto row = std::ranges::find(weights.observed_names(), observed);
  const auto column = std::ranges::find(weights.map_names(), map);
  std::size_t band = 0;
  while (elevation_deg >= weights.bands()[band].elevation_max_deg) ++band;
  return weights.weight(band,
                        static_cast<std::size_t>(row - weights.observed_names().begin()),
                        static_cast<std::size_t>(column - weights.map_names().begin()));
}

inline std::int32_t literal_observed_pixels(const Observation& observation) {
  std::int32_t count = 0;
  for (const ClassId label : observation.labels.pixels()) {
    if (label != kUnknown && label != kNoHit) ++count;
  }
  return count;
}

/// floor(min(400, 32767 / (rows · max|w|))), less where a rounded-up weight would not fit int16.
inline std::int32_t literal_scale(const similarity::WeightMatrix& weights, int rows) {
  const double largest = weights.max_abs_weight();
  auto scale = static_cast<std::int32_t>(std::min(400.0, std::floor(32767.0 / (rows * largest))));
  while (std::round(largest * scale) * rows > 32767.0) --scale;
  return scale;
}

/// Sum over the observed pixels of the integer weight of (observed class, class of the view turned
/// to `heading`) in the same pixel.
inline std::int32_t literal_sum(const Observation& observation,
                                const similarity::WeightMatrix& weights,
                                const ClassTable& map_classes,
                                const PanoramaCamera& camera,
                                const ColumnView& view,
                                int heading) {
  const LabelImage synthesized = view.to_labels(heading);
  const std::int32_t scale = literal_scale(weights, camera.rows);
  std::int32_t sum = 0;
  for (int r = 0; r < camera.rows; ++r) {
    const double elevation_deg = deg_from_rad(camera.elevation_rad(r));
    for (int c = 0; c < camera.columns; ++c) {
      const ClassId observed = observation.labels.at(r, c);
      if (observed == kUnknown || observed == kNoHit) continue;
      const double weight = literal_weight(weights,
                                           elevation_deg,
                                           observation.classes.name(observed),
                                           map_classes.name(synthesized.at(r, c)));
      sum += static_cast<std::int32_t>(std::lround(weight * scale));
    }
  }
  return sum;
}

/// The same with real weights, over the number of observed pixels: equation (1) itself.
inline double literal_similarity(const Observation& observation,
                                 const similarity::WeightMatrix& weights,
                                 const ClassTable& map_classes,
                                 const PanoramaCamera& camera,
                                 const LabelImage& synthesized) {
  double sum = 0.0;
  for (int r = 0; r < camera.rows; ++r) {
    const double elevation_deg = deg_from_rad(camera.elevation_rad(r));
    for (int c = 0; c < camera.columns; ++c) {
      const ClassId observed = observation.labels.at(r, c);
      if (observed == kUnknown || observed == kNoHit) continue;
      sum += literal_weight(weights,
                            elevation_deg,
                            observation.classes.name(observed),
                            map_classes.name(synthesized.at(r, c)));
    }
  }
  return sum / literal_observed_pixels(observation);
}

}  // namespace semview::reference
