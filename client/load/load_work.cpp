// SPDX-License-Identifier: Apache-2.0
#include "client/load/load_work.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "client/lib/remote_maps.hpp"
#include "client/lib/remote_view_source.hpp"
#include "semview/core/random.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/protocol/map_wire.hpp"
#include "semview/protocol/score_wire.hpp"

namespace semview::client {
namespace {

/// Pixels of an observation that a network would get wrong.
constexpr double kWrongPixels = 0.1;

/// The matrix that lies beside the map, or equal names if none does.
Result<similarity::WeightMatrix> weights_of(const protocol::MapDescription& map) {
  auto identity = similarity::WeightMatrix::identity(map.classes);
  if (map.weights_csv.empty()) return identity;
  SEMVIEW_TRY(auto weights, similarity::parse_weight_matrix(map.weights_csv, "the map's weights"));
  return weights.observed_names().size() <= kMaxClasses ? std::move(weights) : std::move(identity);
}

/// For each map class, 0 included, the observer's class that fits it best.
std::vector<ClassId> observed_as(const similarity::WeightMatrix& weights, const ClassTable& map) {
  std::vector<ClassId> labels(static_cast<std::size_t>(map.size()) + 1, kUnknown);
  for (std::size_t i = 1; i < labels.size(); ++i) {
    const auto& names = weights.map_names();
    const auto column =
        static_cast<std::size_t>(std::ranges::find(names, map.names()[i - 1]) - names.begin());
    if (column == names.size()) continue;
    std::size_t best = 0;
    for (std::size_t row = 1; row < weights.observed_names().size(); ++row) {
      if (weights.weight(0, row, column) > weights.weight(0, best, column)) best = row;
    }
    labels[i] = static_cast<ClassId>(best + 1);
  }
  return labels;
}

/// What a camera all around would see, with some of it wrong.
Observation observed(const ColumnView& view,
                     int heading,
                     const similarity::WeightMatrix& weights,
                     const ClassTable& map,
                     Rng& rng) {
  LabelImage labels = view.to_labels(heading);
  const std::vector<ClassId> as = observed_as(weights, map);
  const auto& names = weights.observed_names();
  for (ClassId& label : labels.pixels()) {
    const bool wrong = rng.uniform() < kWrongPixels;
    label = wrong ? static_cast<ClassId>(1 + rng.below(names.size())) : as[label];
  }
  return {ClassTable({names.begin(), names.end()}), std::move(labels), 0.0};
}

double any_yaw(Rng& rng) { return rng.uniform(-kPi, kPi); }

/// Centres of distinct cells, as many as there are.
ScoreRequest global_request(std::vector<CellIndex> cells, Rng& rng) {
  ScoreRequest request{{}, HeadingMode::kCompass, false};
  const std::size_t count = std::min(cells.size(), kGlobalCells);
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(cells[i], cells[i + rng.below(cells.size() - i)]);
    const Pose2 center = PoseGrid::center(cells[i]);
    request.poses.push_back({center.x_m, center.y_m, any_yaw(rng)});
  }
  return request;
}

ScoreRequest tracking_request(const Pose2& robot, Rng& rng) {
  ScoreRequest request{{}, HeadingMode::kAsGiven, false};
  for (std::size_t i = 0; i < kTrackingPoses; ++i) {
    request.poses.push_back({robot.x_m + rng.normal(0.0, kTrackingSigma_m),
                             robot.y_m + rng.normal(0.0, kTrackingSigma_m),
                             wrap_angle(robot.yaw_rad + rng.normal(0.0, kTrackingSigma_rad))});
  }
  return request;
}

void add_bodies(const protocol::MapSummary& map,
                const std::string& weights_csv,
                LoadWork::Place* place) {
  v1::SetObservationRequest set;
  protocol::to_wire(place->observation, &set);
  set.set_map_id(map.id);
  set.set_fingerprint(protocol::to_wire(map.fingerprint));
  set.set_weights_csv(weights_csv);
  place->observation_body = set.SerializeAsString();
  v1::ScoreRequest score;
  protocol::to_wire(place->request, &score);
  score.set_map_id(map.id);
  score.set_fingerprint(protocol::to_wire(map.fingerprint));
  place->score_body = score.SerializeAsString();
}

}  // namespace

Result<LoadWork> LoadWork::prepare(const ConnectionConfig& config,
                                   const std::string& map_id,
                                   LoadKind kind) {
  SEMVIEW_TRY(const auto source, RemoteViewSource::open(config, map_id));
  const protocol::MapDescription& map = source->map();
  Rng rng(1, kind == LoadKind::kGlobal ? "load/global" : "load/tracking");
  SEMVIEW_TRY(similarity::WeightMatrix weights, weights_of(map));
  LoadWork work(map.classes, std::move(weights));
  std::vector<CellIndex> at;
  for (std::size_t i = 0; i < kPlaces && !map.free_cells.empty(); ++i) {
    at.push_back(map.free_cells[rng.below(map.free_cells.size())]);
  }
  SEMVIEW_TRY(const ViewBatch seen, source->views(at));
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (seen.views[i] == nullptr) continue;
    const Pose2 center = PoseGrid::center(at[i]);
    const Pose2 robot{center.x_m, center.y_m, any_yaw(rng)};
    Place place;
    place.observation =
        observed(*seen.views[i], PoseGrid::key(robot)->heading, work.weights_, map.classes, rng);
    place.request = kind == LoadKind::kGlobal ? global_request(map.free_cells, rng)
                                              : tracking_request(robot, rng);
    add_bodies(map.summary, work.weights_.to_csv(), &place);
    work.places_.push_back(std::move(place));
  }
  if (work.places_.empty()) {
    return fail(ErrorCode::kFailedPrecondition,
                fmt::format("map {}: nothing is seen from its free cells", map_id));
  }
  return work;
}

const LoadWork::Place& LoadWork::place(std::size_t robot, std::size_t cycle) const {
  // Neighbours in time stand at different places.
  return places_[(robot * 7 + cycle) % places_.size()];
}

const std::string& LoadWork::observation(std::size_t robot, std::size_t cycle) const {
  return place(robot, cycle).observation_body;
}

std::string LoadWork::score(std::size_t robot,
                            std::size_t cycle,
                            const std::string& observation_id) const {
  // Messages whose bytes follow each other are read as one that has the fields of both.
  v1::ScoreRequest id;
  id.set_observation_id(observation_id);
  return place(robot, cycle).score_body + id.SerializeAsString();
}

std::vector<CellIndex> LoadWork::cells() const {
  std::vector<CellIndex> cells;
  for (const Place& place : places_) {
    for (const Pose2& pose : place.request.poses) {
      if (const auto cell = PoseGrid::cell(pose.x_m, pose.y_m)) cells.push_back(*cell);
    }
  }
  std::ranges::sort(cells);
  const auto repeated = std::ranges::unique(cells);
  cells.erase(repeated.begin(), repeated.end());
  return cells;
}

}  // namespace semview::client
