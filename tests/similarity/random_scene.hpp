// SPDX-License-Identifier: Apache-2.0
/// Random views, observations and weights for the tests of the scorer.
#pragma once

#include <string>
#include <vector>

#include "semview/core/random.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/column_view.hpp"
#include "semview/view/observation.hpp"

namespace semview::similarity {

inline ClassTable numbered_classes(const std::string& stem, int count) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.push_back(stem + std::to_string(i));
  return ClassTable(std::move(names));
}

/// Columns of a few runs each; class 0 occurs too.
inline LabelImage random_labels(Rng& rng, const PanoramaCamera& camera, int classes) {
  LabelImage labels(camera.rows, camera.columns);
  for (int c = 0; c < camera.columns; ++c) {
    ClassId label = 0;
    for (int r = 0; r < camera.rows; ++r) {
      if (r == 0 || rng.uniform() < 0.15) {
        label = static_cast<ClassId>(rng.below(static_cast<std::uint64_t>(classes) + 1));
      }
      labels.at(r, c) = label;
    }
  }
  return labels;
}

/// Sees the columns [first, last) only, and there a share `unknown` of the pixels not.
inline Observation random_observation(Rng& rng,
                                      const PanoramaCamera& camera,
                                      const ClassTable& classes,
                                      int first,
                                      int last,
                                      double unknown) {
  Observation observation{classes, LabelImage(camera.rows, camera.columns, kUnknown), 0.0};
  for (int r = 0; r < camera.rows; ++r) {
    for (int c = first; c < last; ++c) {
      if (rng.uniform() < unknown) continue;
      observation.labels.at(r, c) =
          static_cast<ClassId>(1 + rng.below(static_cast<std::uint64_t>(classes.size())));
    }
  }
  // One pixel at least.
  observation.labels.at(0, first) = 1;
  return observation;
}

/// Weights in [-largest, largest] for `bands` bands of equal height from -90° to 90°.
inline WeightMatrix random_weights(
    Rng& rng, const ClassTable& observed, const ClassTable& map, int bands, double largest) {
  std::vector<std::string> columns(map.names().begin(), map.names().end());
  columns.insert(columns.begin(), std::string(kNoneColumn));
  std::vector<std::string> rows(observed.names().rbegin(), observed.names().rend());
  std::vector<WeightMatrix::Band> list;
  for (int b = 0; b < bands; ++b) {
    WeightMatrix::Band band{-90.0 + 180.0 * b / bands, -90.0 + 180.0 * (b + 1) / bands, {}};
    for (std::size_t i = 0; i < rows.size() * columns.size(); ++i) {
      band.weights.push_back(rng.uniform() < 0.1 ? (rng.below(2) == 0 ? largest : -largest)
                                                 : rng.uniform(-largest, largest));
    }
    list.push_back(std::move(band));
  }
  return WeightMatrix::build(std::move(rows), std::move(columns), std::move(list)).value();
}

}  // namespace semview::similarity
