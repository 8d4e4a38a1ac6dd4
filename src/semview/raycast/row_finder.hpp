// SPDX-License-Identifier: Apache-2.0
/// From tangents of elevation to the rows of a panorama. Internal to this module.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "semview/geometry/panorama_camera.hpp"

namespace semview::raycast {

/// Rows by the tangents at which their centres look, the highest first.
class RowFinder {
 public:
  explicit RowFinder(const PanoramaCamera& camera);

  int rows() const { return rows_; }

  /// How many rows look higher than a tangent, which may be infinite.
  int rows_above(float tangent) const {
    // The bin never falls with the tangent, so only rows of the same bin need to be compared.
    const float inside = std::min(std::max(tangent, lowest_), highest_);
    const auto bin = static_cast<std::size_t>((inside - lowest_) * bins_a_tangent_);
    int row = rows_above_bin_[bin];
    const float* tangents = tangents_.data();
    if (one_row_a_bin_) return row + (tangents[row] > tangent ? 1 : 0);
    while (tangents[row] > tangent) ++row;
    return row;
  }

 private:
  int rows_;
  std::vector<float> tangents_;  // and -∞ behind them
  float lowest_ = 0.0F;
  float highest_ = 0.0F;
  float bins_a_tangent_ = 0.0F;
  bool one_row_a_bin_ = true;
  std::vector<std::uint16_t> rows_above_bin_;
};

}  // namespace semview::raycast
