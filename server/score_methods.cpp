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

/// One Score request, its poses by the cells whose views they take.
struct Scoring {
  SharedSite site;
  SharedObservation prepared;
  ScoreRequest request;
  similarity::PoseGroups groups;
  ScoreBatch batch;
  std::mutex mutex;  ///< guards batch.origins
};

Status score_part(Scoring& scoring, similarity::CellRange cells, ThreadPool& pool) {
  SEMVIEW_TRY(const ViewOrigins origins,
              similarity::score_cells(*scoring.prepared,
                                      scoring.site->views(),
                                      scoring.request,
                                      scoring.groups,
                                      cells,
                                      pool,
                                      scoring.batch));
  const std::lock_guard lock(scoring.mutex);
  scoring.batch.origins += origins;
  return {};
}

std::vector<Chunk> cut_cells(const std::shared_ptr<Scoring>& scoring, ThreadPool& pool) {
  std::vector<Chunk> chunks;
  const std::size_t count = scoring->groups.cells.size();
  for (std::size_t begin = 0; begin < count; begin += kCellsPerChunk) {
    const similarity::CellRange cells{begin, std::min(begin + kCellsPerChunk, count)};
    chunks.push_back({cells.end - cells.begin,
                      [scoring, cells, &pool] { return score_part(*scoring, cells, pool); }});
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
  SEMVIEW_TRY(scoring->batch, similarity::unscored_batch(*scoring->prepared, scoring->request));
  // By the cell whose view is taken: each view is then asked for by one chunk only, and counted
  // once, as in a call in-process.
  SEMVIEW_TRY(scoring->groups,
              similarity::group_by_cell(scoring->request.poses,
                                        scoring->request.mode,
                                        [&site = *scoring->site](const CellIndex& cell) {
                                          return site.cells().view_cell(cell).value_or(cell);
                                        }));

  Plan plan;
  plan.chunks = cut_cells(scoring, services.inline_pool);
  SEMVIEW_TRY_STATUS(check_queue(services, plan.chunks.size() * kCellsPerChunk, "poses"));
  plan.finish = [scoring]() -> Result<std::string> {
    return protocol::to_wire(scoring->batch).SerializeAsString();
  };
  return plan;
}

}  // namespace semview::server
