// SPDX-License-Identifier: Apache-2.0
#include "semview/evaluation/depth_residuals.hpp"

#include <cmath>
#include <limits>

#include "semview/core/check.hpp"
#include "semview/evaluation/statistics.hpp"

namespace semview::evaluation {

double DepthResiduals::median_m() const { return median(errors_m); }

double DepthResiduals::covered() const {
  return measured == 0 ? std::numeric_limits<double>::quiet_NaN()
                       : static_cast<double>(errors_m.size()) / static_cast<double>(measured);
}

void add_residuals(const Image<float>& measured_m,
                   const Image<float>& predicted_m,
                   double max_depth_m,
                   DepthResiduals& residuals) {
  SEMVIEW_CHECK(measured_m.rows() == predicted_m.rows() &&
                measured_m.columns() == predicted_m.columns());
  for (std::size_t i = 0; i < measured_m.pixels().size(); ++i) {
    const double measured = static_cast<double>(measured_m.pixels()[i]);
    const double predicted = static_cast<double>(predicted_m.pixels()[i]);
    if (!(measured > 0.0 && measured <= max_depth_m)) continue;
    ++residuals.measured;
    if (std::isfinite(predicted)) residuals.errors_m.push_back(std::abs(predicted - measured));
  }
}

}  // namespace semview::evaluation
