// SPDX-License-Identifier: Apache-2.0
#include "summary.hpp"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "semview/evaluation/statistics.hpp"

namespace semview::paper2017 {
namespace {

void add_localized(const Results& results,
                   std::string_view row,
                   std::string_view method,
                   Start start,
                   Summary& summary) {
  std::vector<double> from;
  double by_three = 0.0;
  for (const std::uint64_t world : results.experiment().config.worlds) {
    for (const TrialRecord* drive : results.drives(row, method, start, world)) {
      ++summary.drives;
      const auto image = localized_from(*drive, kLocalizedWithin_m);
      if (!image) continue;
      from.push_back(*image);
      if (*image <= 3) by_three += 1.0;
    }
  }
  const auto drives = static_cast<double>(summary.drives);
  if (!from.empty()) summary.localized_from = evaluation::median(from);
  summary.localized_by_three = by_three / drives;
  summary.never_localized = 1.0 - static_cast<double>(from.size()) / drives;
}

std::string number(double value_m) {
  return std::isnan(value_m) ? "" : fmt::format("{:.3f}", value_m);
}

}  // namespace

std::optional<Summary> summary_of(const Results& results,
                                  std::string_view row,
                                  std::string_view method,
                                  Start start) {
  const std::vector<double> errors_m = results.values(row, method, start, &StopRecord::estimate_m);
  if (errors_m.empty()) return std::nullopt;
  const auto mean = [&](Field field) {
    return evaluation::mean(results.values(row, method, start, field));
  };
  Summary summary;
  summary.best_m = mean(&StopRecord::best_m);
  summary.estimate_m = evaluation::mean(errors_m);
  summary.weighted_mean_m = mean(&StopRecord::weighted_mean_m);
  summary.mean_m = mean(&StopRecord::mean_m);
  summary.min_m = mean(&StopRecord::min_m);
  summary.odometry_m = mean(&StopRecord::odometry_m);
  summary.above_0_3_m = evaluation::share_above(errors_m, 0.3);
  summary.above_1_m = evaluation::share_above(errors_m, 1.0);
  add_localized(results, row, method, start, summary);
  return summary;
}

std::string summary_table(const Results& results, Start start) {
  std::string table =
      "| row | method | drives | best | own estimate | by weight | particles | min | odometry | > "
      "0.3 m | > 1 m | median image | by image 3 | never |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Row& row : results.experiment().rows) {
    for (const std::string& method : results.methods(start)) {
      const std::optional<Summary> summary = summary_of(results, row.id, method, start);
      if (!summary) continue;
      table += fmt::format(
          "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.1f} % | {:.1f} % | {} | {:.0f} % | "
          "{:.0f} % |\n",
          row.id,
          method,
          summary->drives,
          number(summary->best_m),
          number(summary->estimate_m),
          number(summary->weighted_mean_m),
          number(summary->mean_m),
          number(summary->min_m),
          number(summary->odometry_m),
          100.0 * summary->above_0_3_m,
          100.0 * summary->above_1_m,
          summary->localized_from ? fmt::format("{:g}", *summary->localized_from) : "",
          100.0 * summary->localized_by_three,
          100.0 * summary->never_localized);
    }
  }
  return table;
}

}  // namespace semview::paper2017
