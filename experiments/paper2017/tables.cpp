// SPDX-License-Identifier: Apache-2.0
#include "tables.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "methods.hpp"
#include "summary.hpp"

namespace semview::paper2017 {
namespace {

using evaluation::Interval;

constexpr const char* kBaseline = "weighted";
constexpr const char* kOurs = "ours";

/// A column's name and quantity, for example "ours: own estimate (min)".
std::string column_name(const std::string& id) {
  const Method* method = find_method(id);
  if (method == nullptr) return id + ": own estimate";
  const bool best = method->estimate == localization::EstimateKind::kHighestWeight;
  return fmt::format("{}: {} (min)", id, best ? "best" : "own estimate");
}

std::string estimate_and_min(const Results& results,
                             const std::string& row,
                             const std::string& method,
                             Start start) {
  const auto estimate = results.world_means(row, method, start, &StopRecord::estimate_m);
  if (estimate.empty()) return "";
  const auto least = results.world_means(row, method, start, &StopRecord::min_m);
  const double min_m = evaluation::mean(least);
  if (std::isnan(min_m)) return fmt::format("{:.3f}", evaluation::mean(estimate));
  return fmt::format("{:.3f} ({:.3f})", evaluation::mean(estimate), min_m);
}

/// Odometry is the same for all methods: that of the first that has drives.
std::string odometry_of(const Results& results, const std::string& row, Start start) {
  for (const std::string& method : results.methods(start)) {
    const auto means = results.world_means(row, method, start, &StopRecord::odometry_m);
    if (!means.empty()) return fmt::format("{:.3f}", evaluation::mean(means));
  }
  return "";
}

std::vector<std::string> compared_methods(const Results& results, Start start) {
  std::vector<std::string> methods = results.methods(start);
  std::erase_if(methods, is_ablated);
  return methods;
}

struct Against {
  double difference_m = 0.0;
  std::optional<Interval> interval;
  double ratio = 0.0;
};

/// On the same worlds, starts and filter seeds, world by world.
Against against_baseline(const std::vector<double>& method, const std::vector<double>& baseline) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < std::min(method.size(), baseline.size()); ++i) {
    differences.push_back(baseline[i] - method[i]);
  }
  return {evaluation::mean(differences),
          interval_over_worlds(differences),
          evaluation::mean(baseline) / evaluation::mean(method)};
}

std::string difference_text(const Against& against) {
  const std::string difference = fmt::format("{:+.3f}", against.difference_m);
  if (!against.interval) return difference;
  return fmt::format(
      "{} [{:+.3f}, {:+.3f}]", difference, against.interval->low, against.interval->high);
}

/// Empty where nothing was asked of a row.
std::string goal_text(const Row& row, double ratio, double mean_m) {
  if (row.goal.ratio <= 0.0) return "";
  return fmt::format("{} ≥ {:g}, {} ≤ {:.2f} m",
                     ratio >= row.goal.ratio ? "reached" : "**missed**",
                     row.goal.ratio,
                     mean_m <= row.goal.best_m ? "reached" : "**missed**",
                     row.goal.best_m);
}

std::string spread_line(const Results& results,
                        const Row& row,
                        const std::string& method,
                        Start start) {
  const auto means = results.world_means(row.id, method, start, &StopRecord::estimate_m);
  if (means.empty()) return "";
  const auto all = results.values(row.id, method, start, &StopRecord::estimate_m);
  std::string line = fmt::format("| {} | {} | {:.3f} | {:.3f} | {} | {:.1f} % | {:.1f} % |",
                                 row.id,
                                 method,
                                 evaluation::mean(means),
                                 evaluation::median(means),
                                 to_text(interval_over_worlds(means)),
                                 100.0 * evaluation::share_above(all, 0.3),
                                 100.0 * evaluation::share_above(all, 1.0));
  const auto baseline = results.world_means(row.id, kBaseline, start, &StopRecord::estimate_m);
  if (method == kBaseline || baseline.size() != means.size()) return line + " | | |\n";
  const Against against = against_baseline(means, baseline);
  return line + fmt::format(" {} | {:.2f} | {} |\n",
                            difference_text(against),
                            against.ratio,
                            method == kOurs && start == Start::kLocal
                                ? goal_text(row, against.ratio, evaluation::mean(means))
                                : "");
}

std::string localized_line(const Results& results,
                           const Row& row,
                           const std::string& method,
                           Start start) {
  const std::optional<Summary> summary = summary_of(results, row.id, method, start);
  if (!summary) return "";
  return fmt::format("| {} | {} | {} | {} | {:.0f} % | {:.0f} % |\n",
                     row.id,
                     name(start),
                     method,
                     summary->localized_from ? fmt::format("{:g}", *summary->localized_from) : "",
                     100.0 * summary->localized_by_three,
                     100.0 * summary->never_localized);
}

bool is_printed(const Row& row) { return row.printed.odometry_m > 0.0; }

}  // namespace

std::string fig3_table(const Results& results, Start start) {
  const std::vector<std::string> methods = compared_methods(results, start);
  std::string table = "| row |";
  std::string rule = "|---|";
  for (const std::string& method : methods) {
    table += fmt::format(" {} |", column_name(method));
    rule += "---|";
  }
  table += " odometry |";
  rule += "---|";
  const bool printed =
      start == Start::kLocal && std::ranges::any_of(results.experiment().rows, is_printed);
  if (printed) {
    table += " printed: identity | printed: weighted | printed: odometry |";
    rule += "---|---|---|";
  }
  table += "\n" + rule + "\n";
  for (const Row& row : results.experiment().rows) {
    table += fmt::format("| {} |", row.id);
    for (const std::string& method : methods) {
      table += fmt::format(" {} |", estimate_and_min(results, row.id, method, start));
    }
    table += fmt::format(" {} |", odometry_of(results, row.id, start));
    if (printed) {
      table += fmt::format(" {:.3f} ({:.3f}) | {:.3f} ({:.3f}) | {:.3f} |",
                           row.printed.identity_best_m,
                           row.printed.identity_min_m,
                           row.printed.weighted_best_m,
                           row.printed.weighted_min_m,
                           row.printed.odometry_m);
    }
    table += "\n";
  }
  return table;
}

std::string spread_table(const Results& results, Start start) {
  std::string table = fmt::format(
      "| row | method | mean | median over {0} | 95 % over {0} | > 0.3 m | > 1 m | weighted less "
      "this | ratio | goal |\n|---|---|---|---|---|---|---|---|---|---|\n",
      results.experiment().means_over);
  for (const Row& row : results.experiment().rows) {
    for (const std::string& method : compared_methods(results, start)) {
      table += spread_line(results, row, method, start);
    }
  }
  return table;
}

std::string localized_table(const Results& results) {
  std::string table =
      "| row | start | method | median image | by image 3 | never |\n|---|---|---|---|---|---|\n";
  for (const Row& row : results.experiment().rows) {
    for (const Start start : results.experiment().config.starts) {
      for (const std::string& method : compared_methods(results, start)) {
        table += localized_line(results, row, method, start);
      }
    }
  }
  return table;
}

std::string image_table(const Results& results, Start start) {
  int images = 0;
  for (const TrialRecord& trial : results.experiment().trials) {
    if (trial.start == start) images = std::max(images, static_cast<int>(trial.stops.size()));
  }
  std::string table = "| row | method |";
  std::string rule = "|---|---|";
  for (int image = 1; image <= images; ++image) {
    table += fmt::format(" {} |", image);
    rule += "---|";
  }
  table += "\n" + rule + "\n";
  const auto line = [&](const Row& row, const std::string& method, Field field, const char* name) {
    table += fmt::format("| {} | {} |", row.id, name);
    for (int image = 1; image <= images; ++image) {
      const double error_m =
          evaluation::mean(results.values_at(row.id, method, start, field, image));
      table += std::isnan(error_m) ? " |" : fmt::format(" {:.3f} |", error_m);
    }
    table += "\n";
  };
  for (const Row& row : results.experiment().rows) {
    std::string last;
    for (const std::string& method : compared_methods(results, start)) {
      if (results.values(row.id, method, start, &StopRecord::estimate_m).empty()) continue;
      line(row, method, &StopRecord::estimate_m, method.c_str());
      last = method;
    }
    // Odometry is the same for all methods.
    if (!last.empty()) line(row, last, &StopRecord::odometry_m, "odometry");
  }
  return images > 0 ? table : "";
}

std::string distortion_table(const Results& results, Start start) {
  std::string lines;
  for (const Row& row : results.experiment().rows) {
    std::vector<double> a;
    std::vector<double> b;
    std::vector<double> k;
    double within = 0.0;
    for (const TrialRecord& trial : results.experiment().trials) {
      if (trial.row != row.id || trial.method != kOurs || trial.start != start) continue;
      const MapAffine& found = trial.stops.back().affine;
      a.push_back(std::abs(found.a / row.affine.a - 1.0));
      b.push_back(std::abs(found.b / row.affine.b - 1.0));
      k.push_back(std::abs(found.k - row.affine.k));
      if (std::max({a.back(), b.back(), k.back()}) <= 0.02) within += 1.0;
    }
    if (a.empty()) continue;
    lines += fmt::format("| {} | {:g} | {:g} | {:g} | {:.1f} % | {:.1f} % | {:.3f} | {:.0f} % |\n",
                         row.id,
                         row.affine.a,
                         row.affine.b,
                         row.affine.k,
                         100.0 * evaluation::mean(a),
                         100.0 * evaluation::mean(b),
                         evaluation::mean(k),
                         100.0 * within / static_cast<double>(a.size()));
  }
  if (lines.empty()) return "";
  return "| row | x scale | y scale | shear | error of x scale | of y scale | of shear | all three "
         "within 2 % |\n|---|---|---|---|---|---|---|---|\n" +
         lines;
}

std::string ablation_table(const Results& results, Start start) {
  std::vector<std::string> methods = results.methods(start);
  if (std::ranges::none_of(methods, is_ablated)) return "";
  std::erase_if(methods, [](const std::string& one) { return one != kOurs && !is_ablated(one); });
  std::string table = "| row |";
  std::string rule = "|---|";
  for (const std::string& method : methods) {
    table += fmt::format(" {} |", method);
    rule += "---|";
  }
  table += "\n" + rule + "\n";
  for (const Row& row : results.experiment().rows) {
    table += fmt::format("| {} |", row.id);
    for (const std::string& method : methods) {
      const auto means = results.world_means(row.id, method, start, &StopRecord::estimate_m);
      table += means.empty() ? " |"
                             : fmt::format(" {:.3f} ({}) |",
                                           evaluation::mean(means),
                                           to_text(interval_over_worlds(means)));
    }
    table += "\n";
  }
  return table;
}

}  // namespace semview::paper2017
