// SPDX-License-Identifier: Apache-2.0
#include "summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "semview/evaluation/statistics.hpp"

namespace semview::paper2023 {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A line of Table 1 or 2; variances of positions are printed in hundredths of a square metre.
struct Printed {
  std::string_view method;
  double position_m;
  double variance_cm;
  double heading_rad;
  double heading_variance;
};

constexpr std::array<Printed, 5> kTable1 = {{
    {"sdf", 0.4371, 59.31, 0.0954, 0.01819},
    {"sem_gt", 0.1894, 2.50, 0.0681, 0.0085},
    {"sem_rcnn", 0.1741, 1.99, 0.0739, 0.0092},
    {"sdf_sem_gt", 0.1309, 1.23, 0.0541, 0.0047},
    {"sdf_sem_rcnn", 0.1491, 1.54, 0.0615, 0.0053},
}};
/// Of sdf, the only method of which a run failed.
constexpr Printed kTable1WithoutFailed{"sdf", 0.2423, 3.58, 0.0697, 0.01284};

constexpr std::array<Printed, 5> kTable2 = {{
    {"sdf", 0.5269, 16.93, 0.1031, 0.0146},
    {"sem_gt", 0.3650, 7.31, 0.2135, 0.0481},
    {"sem_rcnn", 0.3370, 9.88, 0.2014, 0.0394},
    {"sdf_sem_gt", 0.1912, 2.47, 0.0861, 0.0117},
    {"sdf_sem_rcnn", 0.2222, 6.74, 0.1271, 0.0183},
}};

Printed printed(Session session, const Method& method, bool with_failed) {
  if (session == Session::kStatic && !with_failed && method.id == "sdf") {
    return kTable1WithoutFailed;
  }
  const auto& table = session == Session::kStatic ? kTable1 : kTable2;
  return *std::ranges::find(table, std::string_view(method.printed), &Printed::method);
}

double variance(const std::vector<double>& values) {
  const double mean = evaluation::mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return values.empty() ? kNone : sum / static_cast<double>(values.size());
}

std::string row(std::string_view method,
                const Summary& summary,
                const Printed& paper,
                bool with_failed) {
  return fmt::format(
      "| {}{} | {} of {} | {:.3f} | {:.2f} | {:.4f} | {:.4f} | {:.3f} | {:.2f} | {:.4f} | {:.4f} "
      "| {:.2f} |\n",
      method,
      with_failed ? "" : ", without failed",
      summary.failed,
      summary.runs,
      summary.position_m,
      100.0 * summary.position_variance_m2,
      summary.heading_rad,
      summary.heading_variance_rad2,
      paper.position_m,
      paper.variance_cm,
      paper.heading_rad,
      paper.heading_variance,
      summary.position_m / paper.position_m);
}

}  // namespace

double error_after_convergence_m(const Run& run, const FilterConfig& config) {
  std::vector<double> errors_m;
  for (const StopRecord& stop : run.stops) {
    if (stop.distance_m >= config.converged_after_m) errors_m.push_back(stop.position_m);
  }
  return evaluation::mean(errors_m);
}

bool has_failed(const Run& run, const FilterConfig& config) {
  return error_after_convergence_m(run, config) > config.failed_above_m;
}

Summary summary_of(const Experiment& experiment,
                   Session session,
                   std::string_view method,
                   bool with_failed) {
  const FilterConfig& config = experiment.config.filter;
  Summary summary;
  std::vector<double> positions_m;
  std::vector<double> headings_rad;
  for (const Run& run : experiment.runs) {
    if (run.session != session || run.method != method) continue;
    const bool failed = has_failed(run, config);
    ++summary.runs;
    summary.failed += failed ? 1 : 0;
    if (failed && !with_failed) continue;
    for (const StopRecord& stop : run.stops) {
      if (stop.distance_m < config.converged_after_m) continue;
      positions_m.push_back(stop.position_m);
      headings_rad.push_back(stop.heading_rad);
    }
  }
  summary.position_m = evaluation::mean(positions_m);
  summary.position_variance_m2 = variance(positions_m);
  summary.heading_rad = evaluation::mean(headings_rad);
  summary.heading_variance_rad2 = variance(headings_rad);
  return summary;
}

std::string error_table(const Experiment& experiment, Session session) {
  std::string table =
      "| method | failed | position, m | variance, m²/100 | heading, rad | variance | printed: "
      "position | variance | heading | variance | here / printed |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Method& method : all_methods()) {
    const Summary all = summary_of(experiment, session, method.id, true);
    if (all.runs == 0) continue;
    table += row(method.id, all, printed(session, method, true), true);
    if (all.failed == 0 && !(session == Session::kStatic && method.id == "sdf")) continue;
    table += row(method.id,
                 summary_of(experiment, session, method.id, false),
                 printed(session, method, false),
                 false);
  }
  return table;
}

std::string ratio_table(const Experiment& experiment) {
  std::string table =
      "| method | changed / static | without failed | printed |\n"
      "|---|---|---|---|\n";
  for (const Method& method : all_methods()) {
    const auto ratio = [&](bool with_failed) {
      return summary_of(experiment, Session::kChanged, method.id, with_failed).position_m /
             summary_of(experiment, Session::kStatic, method.id, with_failed).position_m;
    };
    if (std::isnan(ratio(true))) continue;
    // Printed against the static figure without the failed run.
    const double paper = printed(Session::kChanged, method, false).position_m /
                         printed(Session::kStatic, method, false).position_m;
    table += fmt::format(
        "| {} | {:.2f} | {:.2f} | {:.2f} |\n", method.id, ratio(true), ratio(false), paper);
  }
  return table;
}

std::vector<ErrorCurve> error_curves(const Experiment& experiment, Session session) {
  constexpr double kStep_m = 0.25;
  std::vector<ErrorCurve> curves;
  for (const Method& method : all_methods()) {
    std::vector<std::vector<double>> errors_m;
    for (const Run& run : experiment.runs) {
      if (run.session != session || run.method != method.id) continue;
      for (const StopRecord& stop : run.stops) {
        const auto bin = static_cast<std::size_t>(stop.distance_m / kStep_m);
        if (bin >= errors_m.size()) errors_m.resize(bin + 1);
        errors_m[bin].push_back(stop.position_m);
      }
    }
    ErrorCurve curve;
    curve.method = method.id;
    for (std::size_t bin = 0; bin < errors_m.size(); ++bin) {
      if (errors_m[bin].empty()) continue;
      curve.distance_m.push_back((static_cast<double>(bin) + 0.5) * kStep_m);
      curve.position_m.push_back(evaluation::mean(errors_m[bin]));
    }
    if (!curve.distance_m.empty()) curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace semview::paper2023
