// SPDX-License-Identifier: Apache-2.0
/// Equation (1) of the 2017 paper pixel by pixel: what the scoring kernel is measured against.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "semview/geometry/pose_grid.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/column_view.hpp"

namespace semview::benchmark {

template <typename Sum>
using HeadingSums = std::array<Sum, PoseGrid::kHeadings>;

/// w[observed][map] by class id, a look-up a pixel: rows that are not scored are all 0, so that the
/// loops need no branch for them.
template <typename Weight>
class PixelWeights {
 public:
  /// The matrix's first band times `scale`, rounded where `Weight` is an integer; it must have
  /// every class of both tables.
  PixelWeights(const similarity::WeightMatrix& weights,
               const ClassTable& observed,
               const ClassTable& map,
               double scale);

  Weight at(ClassId observed, ClassId map) const {
    return values_[static_cast<std::size_t>(observed) * 256 + map];
  }

 private:
  std::vector<Weight> values_ = std::vector<Weight>(std::size_t{256} * 256, Weight{0});
};

extern template class PixelWeights<float>;
extern template class PixelWeights<std::int32_t>;

/// The numerator at every heading. `view` is the view at heading 0, as pixels; its columns are a
/// multiple of 120.
template <typename Weight, typename Sum>
HeadingSums<Sum> score_pixels(const LabelImage& observed,
                              const LabelImage& view,
                              const PixelWeights<Weight>& weights) {
  HeadingSums<Sum> sums{};
  const int columns = observed.columns();
  for (int heading = 0; heading < PoseGrid::kHeadings; ++heading) {
    const int shift = heading * columns / PoseGrid::kHeadings;
    Sum sum{0};
    for (int r = 0; r < observed.rows(); ++r) {
      for (int c = 0; c < columns; ++c) {
        const int turned = c < shift ? c - shift + columns : c - shift;
        sum += weights.at(observed.at(r, c), view.at(r, turned));
      }
    }
    sums[static_cast<std::size_t>(heading)] = sum;
  }
  return sums;
}

}  // namespace semview::benchmark
