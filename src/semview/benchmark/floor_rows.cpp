// SPDX-License-Identifier: Apache-2.0
// One observation against every cell and heading of a floor.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "semview/benchmark/measurement.hpp"
#include "semview/benchmark/scoring_task.hpp"
#include "semview/benchmark/subject_site.hpp"
#include "semview/observation/dense_posterior.hpp"
#include "semview/similarity/heat_map.hpp"
#include "semview/similarity/similarity_score_source.hpp"

namespace semview::benchmark::detail {
namespace {

using observation::DensePosterior;
constexpr double kPoses = 12e6;

/// A site that holds the views of a floor in memory, and an observation made on it.
struct Floor {
  std::shared_ptr<service::Site> site;
  std::vector<CellIndex> cells;
  ScoringTask task;  ///< its views are not used: they are the site's

  /// 0 without a view; the largest is that of the best heading.
  using Sums = std::array<std::int32_t, PoseGrid::kHeadings>;
  Result<std::vector<Sums>> sums() const {
    SEMVIEW_TRY(const ViewBatch batch, site->views().views(cells));
    std::vector<Sums> all(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      task.prepared.all_headings(*batch.views[i], all[i]);
    }
    return all;
  }
};

Result<Floor> open_floor(const Circumstances& in, Row& row) {
  SEMVIEW_TRY(const ScratchFolder folder, ScratchFolder::make());
  SEMVIEW_TRY(const std::filesystem::path map, bundle_of(in.subject, folder));
  service::SiteConfig config = config_of(in);
  config.memory_bytes = std::uint64_t{2} << 30U;  // 100 000 views with room to spare
  std::vector<CellIndex> cells = in.subject.sample(in.extent.floor_cells);
  std::ranges::sort(cells);
  SEMVIEW_TRY(std::shared_ptr<service::Site> site, open_site(map, config, row));
  SEMVIEW_TRY(ScoringTask task, scoring_task(in.subject, in.camera, 1));
  // Random weights may give no similarity above 0, and so no belief: equal names score here.
  const ClassTable& classes = in.subject.map->classes;
  task.weights = similarity::WeightMatrix::identity(classes);
  SEMVIEW_TRY(
      task.prepared,
      similarity::PreparedObservation::build(task.observation, task.weights, classes, in.camera));
  return Floor{std::move(site), std::move(cells), std::move(task)};
}

/// The time of `work` on this floor, as if it had 12 M poses.
Finding floor_finding(const Circumstances& in,
                      const Floor& floor,
                      const std::function<void()>& work,
                      const std::string& agreement) {
  const Timing time = time_alone({1, [&work](std::size_t) { work(); }}, in.pool, in.extent.turns);
  const double poses = static_cast<double>(floor.cells.size()) * PoseGrid::kHeadings;
  Finding found;
  found.unit = std::string("s");
  found.ours = time.least_s * kPoses / poses;
  found.ours_median = time.median_s * kPoses / poses;
  found.clock = std::string(name_of(clock_for(in.pool)));
  found.agreement = fmt::format("{}; measured on {:.1f} M poses", agreement, 1e-6 * poses);
  return found;
}

/// The largest difference of a probability from that of the formula, pose by pose.
double worst_probability(const Floor& floor,
                         const std::vector<Floor::Sums>& sums,
                         const DensePosterior& posterior) {
  const observation::SimilarityWeightingConfig config;
  const auto weight = [&](std::int32_t sum) {
    return std::exp(log_weight(config, floor.task.prepared.similarity(sum)));
  };
  double total = 0.0;
  for (const Floor::Sums& of_cell : sums) {
    for (const std::int32_t sum : of_cell) total += weight(sum);
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    for (int k = 0; k < PoseGrid::kHeadings; ++k) {
      const double expected = weight(sums[i][static_cast<std::size_t>(k)]) / total;
      worst = std::max(worst, std::abs(posterior.probability(i, k) - expected));
    }
  }
  return worst;
}

/// What `semview localize --global dense` computes when it begins.
Status dense_posterior(const Circumstances& in, Row& row) {
  SEMVIEW_TRY(const Floor floor, open_floor(in, row));
  SEMVIEW_TRY(const std::vector<Floor::Sums> sums, floor.sums());
  similarity::SimilarityScoreSource source(
      floor.site->views(), in.subject.map->classes, floor.task.weights, floor.site->pool());
  SEMVIEW_TRY_STATUS(source.set_observation(floor.task.observation));
  auto posterior = DensePosterior::compute(source, {}, floor.cells, {});
  if (!posterior) return fail(posterior.error());
  if (!posterior->informative()) return fail(ErrorCode::kInternal, "results differ: no belief");
  const double worst = worst_probability(floor, sums, *posterior);
  if (!(worst <= 1e-9)) {
    return fail(ErrorCode::kInternal,
                fmt::format("results differ: probabilities by {:.2g}", worst));
  }
  row.found = floor_finding(
      in,
      floor,
      [&] { posterior = DensePosterior::compute(source, {}, floor.cells, {}); },
      fmt::format("probabilities within {:.1g} of the formula's", worst));
  return {};
}

/// What `semview heatmap` and `Heatmap` of the protocol compute.
Status heat_map(const Circumstances& in, Row& row) {
  SEMVIEW_TRY(const Floor floor, open_floor(in, row));
  SEMVIEW_TRY(const std::vector<Floor::Sums> sums, floor.sums());
  const auto compute = [&] {
    return similarity::heat_map(floor.task.prepared,
                                floor.site->views(),
                                floor.cells,
                                PoseGrid::kHeadings,
                                floor.site->pool());
  };
  auto heat = compute();
  if (!heat) return fail(heat.error());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const CellIndex& cell = floor.cells[i];
    const auto best =
        static_cast<float>(floor.task.prepared.similarity(*std::ranges::max_element(sums[i])));
    if (heat->similarity.at(cell.iy - heat->origin.iy, cell.ix - heat->origin.ix) != best) {
      return fail(ErrorCode::kInternal,
                  fmt::format("results differ: the heat map in cell {}, {}", cell.ix, cell.iy));
    }
  }
  row.found = floor_finding(
      in, floor, [&] { heat = compute(); }, fmt::format("{} cells equal", sums.size()));
  return {};
}

}  // namespace

std::vector<RowKind> floor_rows() {
  return {
      {"posterior",
       "dense posterior of 12 M poses, as --global dense begins",
       {{"at most 1 s, then 0.5 s", 1.0, 0.5, true, true}},
       Plans::kFirst,
       false,
       dense_posterior},
      {"heatmap", "heat map of 12 M poses", {}, Plans::kFirst, false, heat_map},
  };
}

}  // namespace semview::benchmark::detail
