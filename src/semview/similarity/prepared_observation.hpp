// SPDX-License-Identifier: Apache-2.0
/// An observation turned into tables from which a view's score is read off run by run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/similarity/prefix_table.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/column_view.hpp"
#include "semview/view/observation.hpp"

namespace semview::similarity {

/// Tables above this size are refused; the default profile with 20 classes takes 1.4 MB.
inline constexpr std::size_t kMaxTableBytes = std::size_t{256} << 20U;

/// Equation (1)'s numerator for any view and heading, exact in integers.
///
/// Weights are rounded to integers, round(w · weight_scale()). P[row][map class][column] holds
/// their sum over the observed pixels above `row` in one column, as if the whole map were of that
/// class (`PrefixTable`); a run (class, r0, r1) of a view's column m then adds P[r1][class][c] -
/// P[r0][class][c], where c = m + heading · W/120 (mod W). The scale is
/// floor(min(400, 32767 / (H · max|w|))), less where rounding would let an entry of P leave 16 bits
/// (364 for 90 rows and weights up to 1); sums are 32-bit. What was not observed costs nothing:
/// unknown pixels have weight 0, and columns outside the camera's field of view have no entries.
///
/// Immutable. @threads safe
/// @source Neubert et al. 2017, equation (1); the literal form is
/// tests/reference/literal_similarity.hpp
class PreparedObservation {
 public:
  /// @param observation  In the shape of `camera`; pixels `kUnknown` or 0 are not scored.
  /// @errors kInvalidArgument: other shape, a label outside its class table, or nothing observed;
  /// kFailedPrecondition: the matrix misses a class or does not cover an elevation of the camera,
  /// or its weights are too large for any scale; kResourceExhausted: tables above `kMaxTableBytes`.
  static Result<PreparedObservation> build(const Observation& observation,
                                           const WeightMatrix& weights,
                                           const ClassTable& map_classes,
                                           const PanoramaCamera& camera);

  std::int32_t weight_scale() const { return weight_scale_; }
  /// Pixels that count: equation (1)'s denominator.
  std::int32_t observed_pixels() const { return observed_pixels_; }
  double similarity(std::int32_t sum) const {
    return static_cast<double>(sum) /
           (static_cast<double>(weight_scale_) * static_cast<double>(observed_pixels_));
  }
  std::size_t byte_size() const { return sizeof(PreparedObservation) + table_.byte_size(); }

  /// True if `view` has this camera's shape and only classes of this map. The sums below are
  /// defined for such views only.
  bool fits(const ColumnView& view) const;

  /// The sum at one heading of the PoseGrid, in [0, 120). @cost runs of the observed columns
  std::int32_t sum(const ColumnView& view, int heading) const;

  /// The sums at all headings. @cost runs × observed columns / (W/120) 16-bit additions; some
  /// hundredths of a loop over the pixels (bench/RESULTS.md)
  void all_headings(const ColumnView& view,
                    std::span<std::int32_t, PoseGrid::kHeadings> sums) const;

  /// The sum at each of some headings, which may repeat: one after the other, or all at once where
  /// that is cheaper.
  void some_headings(const ColumnView& view,
                     std::span<const std::uint8_t> headings,
                     std::span<std::int32_t> sums) const;

 private:
  PreparedObservation() = default;
  bool sweep_pays(std::size_t headings) const;

  std::int32_t weight_scale_ = 1;
  std::int32_t observed_pixels_ = 0;
  PrefixTable table_;
};

}  // namespace semview::similarity
