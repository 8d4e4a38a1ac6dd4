// SPDX-License-Identifier: Apache-2.0
#include "summary_json.hpp"

#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "experiments/paper2017/summary.hpp"

namespace semview::cli {
namespace {

using nlohmann::ordered_json;

ordered_json number(double value) {
  return std::isnan(value) ? ordered_json() : ordered_json(value);
}

ordered_json as_json(const paper2017::Summary& summary) {
  return {{"drives", summary.drives},
          {"best_m", number(summary.best_m)},
          {"estimate_m", number(summary.estimate_m)},
          {"weighted_mean_m", number(summary.weighted_mean_m)},
          {"particles_m", number(summary.mean_m)},
          {"min_m", number(summary.min_m)},
          {"odometry_m", number(summary.odometry_m)},
          {"above_0.3_m", summary.above_0_3_m},
          {"above_1_m", summary.above_1_m},
          {"localized_from_image",
           summary.localized_from ? ordered_json(*summary.localized_from) : ordered_json()},
          {"localized_by_image_3", summary.localized_by_three},
          {"never_localized", summary.never_localized}};
}

}  // namespace

ordered_json summaries_json(const paper2017::Results& results, const std::string& row_name) {
  ordered_json rows = ordered_json::array();
  for (const paper2017::Row& row : results.experiment().rows) {
    for (const paper2017::Start start : results.experiment().config.starts) {
      for (const std::string& method : results.methods(start)) {
        const auto summary = paper2017::summary_of(results, row.id, method, start);
        if (!summary) continue;
        ordered_json line{{row_name, row.id}, {"start", name(start)}, {"method", method}};
        line.update(as_json(*summary));
        rows.push_back(std::move(line));
      }
    }
  }
  return rows;
}

}  // namespace semview::cli
