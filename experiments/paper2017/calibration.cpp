// SPDX-License-Identifier: Apache-2.0
#include "calibration.hpp"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "label_errors.hpp"

namespace semview::paper2017 {
namespace {

constexpr int kBorderReach_px = 10;
constexpr int kConfusionsShown = 4;

std::string class_name(int label) {
  return std::string(raw_classes().name(static_cast<ClassId>(label + 1)));
}

/// A line a class: how often it is there, its IoU, and what it is called.
std::string class_table(const LabelErrors& errors) {
  std::string table =
      "| class | share of pixels | IoU | named so | otherwise named |\n|---|---|---|---|---|\n";
  std::int64_t all = 0;
  for (int i = 0; i < kRawClassCount; ++i) {
    for (int j = 0; j < kRawClassCount; ++j) all += errors.count(i, j);
  }
  for (int label = 0; label < kRawClassCount; ++label) {
    std::int64_t there = 0;
    std::vector<std::pair<std::int64_t, int>> others;
    for (int named = 0; named < kRawClassCount; ++named) {
      there += errors.count(label, named);
      if (named != label) others.emplace_back(errors.count(label, named), named);
    }
    if (there == 0) continue;
    std::ranges::sort(others, std::greater<>());
    const auto percent = [&](std::int64_t count, std::int64_t of) {
      return 100.0 * static_cast<double>(count) / static_cast<double>(of);
    };
    std::string named;
    for (int i = 0; i < kConfusionsShown; ++i) {
      const auto& [count, other] = others[static_cast<std::size_t>(i)];
      named +=
          fmt::format("{}{} {:.1f} %", i > 0 ? ", " : "", class_name(other), percent(count, there));
    }
    table += fmt::format("| {} | {:.1f} % | {:.2f} | {:.1f} % | {} |\n",
                         class_name(label),
                         percent(there, all),
                         errors.iou(label),
                         percent(errors.count(label, label), there),
                         named);
  }
  return table;
}

/// The whole confusion matrix in per cent of each true class, for programs.
std::string confusion_csv(const LabelErrors& errors) {
  std::string csv = "true";
  for (int named = 0; named < kRawClassCount; ++named) csv += "," + class_name(named);
  csv += "\n";
  for (int truth = 0; truth < kRawClassCount; ++truth) {
    csv += class_name(truth);
    for (int named = 0; named < kRawClassCount; ++named) {
      csv += fmt::format(",{}", errors.count(truth, named));
    }
    csv += "\n";
  }
  return csv;
}

std::string differences_text(const std::vector<World>& worlds) {
  const WorldDifferences found = differences_of(worlds);
  return fmt::format(
      "- {} pieces of furniture: {} are not in the map, {} are drawn and have gone.\n"
      "- {} chairs stand {:.2f} m on average from where they are drawn.\n"
      "- {} of {} doors are open and drawn closed, or the reverse.\n"
      "- {} things are in no map: boxes, plants, pictures, lamps, radiators, monitors, curtains.\n",
      found.furniture,
      found.missing_in_map,
      found.missing_in_world,
      found.chairs,
      found.chair_shift_m,
      found.doors_in_other_state,
      found.doors,
      found.unmapped_things);
}

std::string beside_text(const std::vector<double>& means, double printed) {
  if (means.empty()) return fmt::format(" | | {:.3f} | |", printed);
  const double mean = evaluation::mean(means);
  return fmt::format(" {:.3f} ({}) | {:.3f} | {:.3f} | {:.2f} |",
                     mean,
                     to_text(interval_over_worlds(means)),
                     evaluation::median(means),
                     printed,
                     mean / printed);
}

std::string baseline_table(const Results& results,
                           const std::string& method,
                           Field field,
                           double Printed::*printed) {
  std::string table =
      "| row | here, mean (95 % over worlds) | median over worlds | printed | here / printed |\n"
      "|---|---|---|---|---|\n";
  for (const Row& row : results.experiment().rows) {
    table += fmt::format("| {} |{}\n",
                         row.id,
                         beside_text(results.world_means(row.id, method, Start::kLocal, field),
                                     row.printed.*printed));
  }
  return table;
}

}  // namespace

std::string calibration_page(const Results& results, const ReportHeader& header) {
  const std::vector<World>& worlds = results.experiment().worlds;
  LabelErrors errors;
  for (const World& world : worlds) {
    for (const Stop& stop : world.stops) errors.add(stop.truth.labels, stop.labels);
  }
  const double pixel_deg = deg_from_rad(results.experiment().config.world.camera.pixel_rad);
  std::string page = fmt::format(
      "# How hard the simulated experiment is\n\nWritten by `{}`, commit {}.\n\n"
      "## The network\n\n"
      "Pixel accuracy {:.3f}, mean IoU {:.3f} over the classes that are there, over {} panoramas. "
      "A "
      "true border lies {:.2f}° on average from the nearest border in the labels (those farther "
      "than {:g}° count as that).\n\n{}",
      header.command,
      header.revision,
      errors.pixel_accuracy(),
      errors.mean_iou(),
      worlds.size() * kStops,
      border_error_px(worlds, kBorderReach_px) * pixel_deg,
      kBorderReach_px * pixel_deg,
      class_table(errors));
  page += "\nConfusion matrix, pixels by true class (rows) and name:\n\n```csv\n" +
          confusion_csv(errors) + "```\n";
  page += "\n## World and map\n\n" + differences_text(worlds);
  page += "\n## Odometry, mean error in m\n\n" +
          baseline_table(results, "weighted", &StopRecord::odometry_m, &Printed::odometry_m);
  page += "\n## The baseline with the weighted matrix, best, m\n\n" +
          baseline_table(results, "weighted", &StopRecord::best_m, &Printed::weighted_best_m);
  page += "\n## The nearest particle of the same, m\n\n" +
          baseline_table(results, "weighted", &StopRecord::min_m, &Printed::weighted_min_m);
  page += "\n## The baseline with the identity matrix, best, m\n\n" +
          baseline_table(results, "identity", &StopRecord::best_m, &Printed::identity_best_m);
  return page;
}

}  // namespace semview::paper2017
