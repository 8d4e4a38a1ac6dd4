// SPDX-License-Identifier: Apache-2.0
/// From tangents of elevation to the rows of a panorama. Internal to this module.
#pragma once

#include <cstdint>
#include <vector>

#include "semview/geometry/panorama_camera.hpp"

namespace semview::raycast {

/// Rows by the tangents at which their centres look, the highest first.
class RowFinder {
 public:
  explicit RowFinder(const PanoramaCamera& camera);

  int rows() const { return static_cast<int>(tangents_.size()) - 1; }

  /// How many rows look higher than a tangent, which may be infinite.
  int rows_above(float tangent) const {
    const float* tangents = tangents_.data();
    int row = rows_above_bin_[static_cast<std::size_t>(bin(tangent))];
    if (one_row_a_bin_) return row + (tangents[row] > tangent ? 1 : 0);
    while (tangents[row] > tangent) ++row;
    return row;
  }

 private:
  /// Never falls with the tangent, so that only rows of one's own bin need to be compared.
  int bin(float tangent) const {
    const float inside = tangent < lowest_ ? lowest_ : tangent > highest_ ? highest_ : tangent;
    return static_cast<int>((inside - lowest_) * bins_a_tangent_);
  }

  std::vector<float> tangents_;  // and -∞ behind them
  float lowest_ = 0.0F;
  float highest_ = 0.0F;
  float bins_a_tangent_ = 0.0F;
  bool one_row_a_bin_ = true;
  std::vector<std::uint16_t> rows_above_bin_;
};

}  // namespace semview::raycast
