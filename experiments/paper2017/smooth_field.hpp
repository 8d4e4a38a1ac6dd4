// SPDX-License-Identifier: Apache-2.0
/// Random values that change slowly over an image: what moves borders and makes patches.
#pragma once

#include <vector>

#include "semview/core/random.hpp"

namespace semview::paper2017 {

/// Random values at nodes `wave` apart, bilinear between them.
class SmoothField {
 public:
  SmoothField(int rows, int columns, double wave_px, Rng& rng) : wave_px_(wave_px) {
    rows_ = static_cast<int>(rows / wave_px) + 2;
    columns_ = static_cast<int>(columns / wave_px) + 2;
    for (int i = 0; i < rows_ * columns_; ++i) nodes_.push_back(rng.normal(0.0, 1.0));
  }

  double at(int row, int column) const {
    const double y = row / wave_px_;
    const double x = column / wave_px_;
    const int r = static_cast<int>(y);
    const int c = static_cast<int>(x);
    const double fy = y - r;
    const double fx = x - c;
    return (1.0 - fy) * ((1.0 - fx) * node(r, c) + fx * node(r, c + 1)) +
           fy * ((1.0 - fx) * node(r + 1, c) + fx * node(r + 1, c + 1));
  }

 private:
  double node(int row, int column) const {
    return nodes_[static_cast<std::size_t>(row * columns_ + column)];
  }

  double wave_px_;
  int rows_ = 0;
  int columns_ = 0;
  std::vector<double> nodes_;
};

}  // namespace semview::paper2017
