// SPDX-License-Identifier: Apache-2.0
/// How well a surface predicts depth images that it was not made of.
#pragma once

#include <cstddef>
#include <vector>

#include "semview/geometry/image.hpp"

namespace semview::evaluation {

/// Of all pixels of all images together.
struct DepthResiduals {
  std::size_t measured = 0;      ///< pixels with a depth in the range compared
  std::vector<double> errors_m;  ///< |predicted - measured| of those where a surface is predicted

  /// NaN of no pixels.
  double median_m() const;
  /// Of the measured pixels the share with a surface; NaN of no pixels.
  double covered() const;
};

/// Takes one image. Depths of 0, that are not finite, or farther than `max_depth_m` are not
/// measured, or not predicted. Both have one size.
void add_residuals(const Image<float>& measured_m,
                   const Image<float>& predicted_m,
                   double max_depth_m,
                   DepthResiduals& residuals);

}  // namespace semview::evaluation
