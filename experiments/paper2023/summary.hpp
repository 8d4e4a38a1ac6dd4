// SPDX-License-Identifier: Apache-2.0
/// What the runs of one method come to, and the paper's tables made of that.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiment.hpp"

namespace semview::paper2023 {

/// Mean error of a run over the images after the filter has converged.
double error_after_convergence_m(const Run& run, const FilterConfig& config);

/// Whether that is above `failed_above_m`.
bool has_failed(const Run& run, const FilterConfig& config);

/// Over all images after convergence of the runs of a method.
struct Summary {
  int runs = 0;
  int failed = 0;
  double position_m = 0.0;
  double position_variance_m2 = 0.0;
  double heading_rad = 0.0;
  double heading_variance_rad2 = 0.0;
};

/// NaN where there is no run.
Summary summary_of(const Experiment& experiment,
                   Session session,
                   std::string_view method,
                   bool with_failed);

/// Table 1 (static) or 2 (changed) beside the printed figures, in Markdown.
std::string error_table(const Experiment& experiment, Session session);

/// Position error after changes over that before, beside the printed ones.
std::string ratio_table(const Experiment& experiment);

/// Mean position error a method over what was driven, in steps of 25 cm.
struct ErrorCurve {
  std::string method;
  std::vector<double> distance_m;
  std::vector<double> position_m;
};
std::vector<ErrorCurve> error_curves(const Experiment& experiment, Session session);

}  // namespace semview::paper2023
