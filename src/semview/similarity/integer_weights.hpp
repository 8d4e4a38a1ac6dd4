// SPDX-License-Identifier: Apache-2.0
/// The weights that a score adds up, as integers. Inside the module only.
#pragma once

#include <cstdint>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace semview::similarity {

/// round(w · scale) for each row of a panorama.
struct IntegerWeights {
  /// A band each: [map class][observed label]; labels that are not scored have zeros.
  std::vector<std::vector<std::int16_t>> of_band;
  std::vector<const std::int16_t*> of_row;  ///< into `of_band`

  std::int16_t at(int row, ClassId observed, ClassId map) const {
    return of_row[static_cast<std::size_t>(row)][std::size_t{256} * map + observed];
  }
};

/// @param weights  Has the classes of both tables, and no weight that leaves 16 bits.
/// @errors kFailedPrecondition: no band for an elevation of `camera`.
Result<IntegerWeights> integer_weights(const WeightMatrix& weights,
                                       std::int32_t scale,
                                       const ClassTable& observed,
                                       const ClassTable& map,
                                       const PanoramaCamera& camera);

/// Observed labels that count.
inline bool is_scored(ClassId label) { return label != kNoHit && label != kUnknown; }

}  // namespace semview::similarity
