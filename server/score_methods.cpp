// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "methods.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/score_wire.hpp"
#include "semview/protocol/view_wire.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "semview/similarity/score_poses.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace semview::server {
namespace {

using SharedSite = std::shared_ptr<service::Site>;

/// One Score request, its poses in order of their cells and cut between cells.
struct Scoring {
  SharedSite site;
  SharedObservation prepared;
  ScoreRequest request;
  std::vector<std::size_t> order;  ///< of the poses
  ScoreBatch batch;
  std::mutex mutex;  ///< guards batch.origins
};

Status score_part(Scoring& scoring, std::size_t begin, std::size_t end, ThreadPool& pool) {
  ScoreRequest part{{}, scoring.request.mode, scoring.request.whole_curve};
  part.poses.reserve(end - begin);
  for (std::size_t i = begin; i < end; ++i) {
    part.poses.push_back(scoring.request.poses[scoring.order[i]]);
  }
  SEMVIEW_TRY(const ScoreBatch scored,
              similarity::score_poses(*scoring.prepared, scoring.site->views(), part, pool));
  constexpr std::size_t kHeadings = PoseGrid::kHeadings;
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t from = i - begin;
    const std::size_t to = scoring.order[i];
    scoring.batch.sums[to] = scored.sums[from];
    if (!scored.best_heading.empty()) scoring.batch.best_heading[to] = scored.best_heading[from];
    if (!scored.curve.empty()) {
      std::copy_n(&scored.curve[from * kHeadings], kHeadings, &scoring.batch.curve[to * kHeadings]);
    }
  }
  const std::lock_guard lock(scoring.mutex);
  scoring.batch.origins += scored.origins;
  return {};
}

/// A pose and the cell whose view it takes; sorted as they are, without a look elsewhere.
using PoseOfCell = std::pair<CellIndex, std::size_t>;

/// Cuts the poses, in order, into chunks of whole cells.
std::vector<Chunk> cut_poses(const std::shared_ptr<Scoring>& scoring,
                             const std::vector<PoseOfCell>& poses,
                             ThreadPool& pool) {
  std::vector<Chunk> chunks;
  const std::size_t count = poses.size();
  std::size_t begin = 0;
  std::size_t distinct = 0;
  for (std::size_t i = 0; i < count; ++i) {
    distinct += i == begin || poses[i].first != poses[i - 1].first ? 1 : 0;
    const bool last_of_cell = i + 1 == count || poses[i + 1].first != poses[i].first;
    if (last_of_cell && (distinct == kCellsPerChunk || i + 1 == count)) {
      chunks.push_back({distinct, [scoring, begin, end = i + 1, &pool] {
                          return score_part(*scoring, begin, end, pool);
                        }});
      begin = i + 1;
      distinct = 0;
    }
  }
  return chunks;
}

using SharedWeights = std::shared_ptr<const similarity::WeightMatrix>;

/// @errors those of the matrix, with field `weights_csv`.
Result<SharedWeights> read_weights(Services& services,
                                   const std::string& csv,
                                   const ClassTable& map_classes) {
  constexpr std::string_view kField = "weights_csv";
  if (csv.empty()) {
    return std::make_shared<const similarity::WeightMatrix>(
        similarity::WeightMatrix::identity(map_classes));
  }
  Result<SharedWeights> weights = services.weights.read(csv, kField);
  if (weights) return weights;
  Error error = std::move(weights).error();
  error.field = kField;
  return fail(std::move(error));
}

}  // namespace

Result<Plan> plan_set_observation(Services& services, const Request& request) {
  SEMVIEW_TRY(const auto wire, protocol::parse<v1::SetObservationRequest>(request.body, "body"));
  SEMVIEW_TRY(const SharedSite site, find_site(services, wire.map_id(), wire.fingerprint()));
  SEMVIEW_TRY(const Observation observation, protocol::from_wire(wire));
  const PanoramaCamera& camera = site->profile().camera;
  if (observation.labels.rows() != camera.rows || observation.labels.columns() != camera.columns) {
    return protocol::wrong_field("labels",
                                 fmt::format("{} rows × {} columns; expected {} × {}, the map's",
                                             observation.labels.rows(),
                                             observation.labels.columns(),
                                             camera.rows,
                                             camera.columns));
  }
  SEMVIEW_TRY(const SharedWeights weights,
              read_weights(services, wire.weights_csv(), site->map().classes));
  Result<similarity::PreparedObservation> prepared =
      similarity::PreparedObservation::build(observation, *weights, site->map().classes, camera);
  if (!prepared) {
    Error error = std::move(prepared).error();
    if (error.code == ErrorCode::kFailedPrecondition) {
      error.field = "weights_csv";
    } else if (error.field.empty()) {
      error.field = "labels";
    }
    return fail(std::move(error));
  }
  // Moved: the tables are a megabyte.
  const auto shared = std::make_shared<const similarity::PreparedObservation>(*std::move(prepared));
  SEMVIEW_TRY(const std::uint64_t number,
              services.observations.add(request.client, {shared, site->id()}, shared->byte_size()));
  v1::SetObservationReply reply;
  reply.set_observation_id(wire_id(services, number));
  reply.set_weight_scale(shared->weight_scale());
  reply.set_observed_pixels(shared->observed_pixels());
  return answer(reply.SerializeAsString());
}

Result<Plan> plan_score(Services& services, const Request& request) {
  SEMVIEW_TRY(const auto wire, protocol::parse<v1::ScoreRequest>(request.body, "body"));
  const auto scoring = std::make_shared<Scoring>();
  SEMVIEW_TRY(scoring->site, find_site(services, wire.map_id(), wire.fingerprint()));
  SEMVIEW_TRY(scoring->prepared, find_observation(services, wire.observation_id(), wire.map_id()));
  const std::size_t limit =
      wire.whole_curve() ? services.limits.max_curve_poses : services.limits.max_poses;
  SEMVIEW_TRY(scoring->request, protocol::from_wire(wire, limit));
  const std::vector<Pose2>& poses = scoring->request.poses;
  // By the cell whose view is taken: each view is then asked for by one chunk only, and counted
  // once, as in a call in-process.
  std::vector<PoseOfCell> by_cell(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto cell = PoseGrid::cell(poses[i].x_m, poses[i].y_m);
    if (!cell) return protocol::wrong_field("poses", fmt::format("entry {} has no cell", i));
    by_cell[i] = {scoring->site->cells().view_cell(*cell).value_or(*cell), i};
  }
  std::ranges::sort(by_cell);
  scoring->order.reserve(poses.size());
  for (const PoseOfCell& pose : by_cell) scoring->order.push_back(pose.second);

  ScoreBatch& batch = scoring->batch;
  batch.weight_scale = scoring->prepared->weight_scale();
  batch.observed_pixels = scoring->prepared->observed_pixels();
  batch.sums.resize(poses.size());
  if (scoring->request.mode == HeadingMode::kCompass) batch.best_heading.resize(poses.size());
  if (scoring->request.whole_curve) batch.curve.resize(poses.size() * PoseGrid::kHeadings);

  Plan plan;
  plan.chunks = cut_poses(scoring, by_cell, services.inline_pool);
  SEMVIEW_TRY_STATUS(check_queue(services, plan.chunks.size() * kCellsPerChunk, "poses"));
  plan.finish = [scoring]() -> Result<std::string> {
    return protocol::to_wire(scoring->batch).SerializeAsString();
  };
  return plan;
}

}  // namespace semview::server
