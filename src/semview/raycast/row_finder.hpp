// SPDX-License-Identifier: Apache-2.0
/// From tangents of elevation to the rows of a panorama. Internal to this module.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "semview/geometry/panorama_camera.hpp"

namespace semview::raycast {

/// Rows by the tangents at which their centres look, the highest first. A view of a `RowFinder`'s
/// tables, to be copied.
struct RowTable {
  const float* tangents = nullptr;  // and -∞ behind them
  const std::uint16_t* rows_above_bin = nullptr;
  const std::uint64_t* bits_above = nullptr;  // [row · words]: the bits of the rows above a row
  float lowest = 0.0F;
  float highest = 0.0F;
  float bins_a_tangent = 0.0F;
  bool one_row_a_bin = true;
  int rows = 0;

  /// How many rows look higher than a tangent, which may be infinite.
  int rows_above(float tangent) const {
    // The bin never falls with the tangent, so only rows of the same bin need to be compared.
    const float inside = std::min(std::max(tangent, lowest), highest);
    int row = rows_above_bin[bin(inside)];
    if (one_row_a_bin) return row + (tangents[row] > tangent ? 1 : 0);
    while (tangents[row] > tangent) ++row;
    return row;
  }
  std::int32_t bin(float tangent) const {
    return static_cast<std::int32_t>((tangent - lowest) * bins_a_tangent);
  }
};

/// The tables of a camera.
class RowFinder {
 public:
  explicit RowFinder(const PanoramaCamera& camera);

  RowTable table() const;
  /// Words that hold a bit a row: 2, 3 or 16.
  std::size_t words() const { return words_; }

 private:
  RowTable table_;
  std::size_t words_ = 0;
  std::vector<float> tangents_;
  std::vector<std::uint16_t> rows_above_bin_;
  std::vector<std::uint64_t> bits_above_;
};

}  // namespace semview::raycast
