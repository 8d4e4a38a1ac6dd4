// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/scoring_task.hpp"

#include <string>
#include <utility>

#include "semview/core/random.hpp"

namespace semview::benchmark::detail {
namespace {

LabelImage observe(const Subject& subject, const CellIndex& cell, const PanoramaCamera& camera) {
  raycast::PanoramaRequest request = subject.request(cell, camera);
  request.map_from_robot.x_m += 0.03;
  request.map_from_robot.y_m -= 0.02;
  request.map_from_robot.yaw_rad = 0.7;
  request.eye_z_m += 0.02;
  LabelImage labels = raycast::render_panorama(*subject.scene, request).labels;
  Rng rng(1, "benchmark observation");
  const auto classes = static_cast<std::uint64_t>(subject.map->classes.size());
  for (ClassId& label : labels.pixels()) {
    if (rng.uniform() < 0.1) label = static_cast<ClassId>(1 + rng.below(classes));
  }
  return labels;
}

Result<similarity::WeightMatrix> random_weights(const ClassTable& classes) {
  const std::vector<std::string> observed(classes.names().begin(), classes.names().end());
  std::vector<std::string> map = observed;
  map.emplace_back(similarity::kNoneColumn);
  similarity::WeightMatrix::Band band;
  Rng rng(1, "benchmark weights");
  for (std::size_t i = 0; i < observed.size() * map.size(); ++i) {
    band.weights.push_back(rng.uniform(-1.0, 1.0));
  }
  return similarity::WeightMatrix::build(observed, map, {band});
}

}  // namespace

Result<ScoringTask> scoring_task(const Subject& subject,
                                 const PanoramaCamera& camera,
                                 std::size_t cells) {
  const std::vector<CellIndex> sample = subject.sample(cells);
  Observation observation{subject.map->classes, observe(subject, sample.front(), camera), 0.0};
  SEMVIEW_TRY(similarity::WeightMatrix weights, random_weights(subject.map->classes));
  SEMVIEW_TRY(
      similarity::PreparedObservation prepared,
      similarity::PreparedObservation::build(observation, weights, subject.map->classes, camera));
  std::vector<ColumnView> views;
  for (const CellIndex& cell : sample) {
    views.push_back(subject.runs(subject.request(cell, camera)));
  }
  return ScoringTask{
      std::move(observation), std::move(weights), std::move(prepared), std::move(views)};
}

}  // namespace semview::benchmark::detail
