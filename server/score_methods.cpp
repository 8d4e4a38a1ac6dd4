// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <deque>
#include <mutex>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "depth_methods.hpp"
#include "methods.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/observation/voxel_reduction.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/model_wire.hpp"
#include "semview/protocol/score_wire.hpp"
#include "semview/protocol/view_wire.hpp"
#include "semview/protocol/voxel_wire.hpp"
#include "semview/similarity/affine_groups.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "semview/similarity/score_poses.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace semview::server {
namespace {

using SharedSite = std::shared_ptr<service::Site>;

/// The poses of a Score request that take the map to be distorted alike, by the cells whose views
/// they take.
struct ScorePart {
  ScorePart(similarity::AffineGroup the_group, ViewSource& source)
      : group(std::move(the_group)), views(source, group.affine) {}

  similarity::AffineGroup group;
  similarity::UndistortedViews views;
  similarity::PoseGroups cells;
  ScoreBatch batch;
};

/// One Score request.
struct Scoring {
  SharedSite site;
  SharedObservation prepared;
  ScoreRequest request;
  std::deque<ScorePart> parts;  ///< one without affines
  std::mutex mutex;             ///< guards the parts' origins
};

/// Cells of one part.
struct Piece {
  ScorePart* part = nullptr;
  similarity::CellRange cells;
};

Status score_pieces(Scoring& scoring, const std::vector<Piece>& pieces, ThreadPool& pool) {
  for (const Piece& piece : pieces) {
    ScorePart& part = *piece.part;
    SEMVIEW_TRY(const ViewOrigins origins,
                similarity::score_cells(*scoring.prepared,
                                        part.views,
                                        part.group.request,
                                        part.cells,
                                        piece.cells,
                                        pool,
                                        part.batch));
    const std::lock_guard lock(scoring.mutex);
    part.batch.origins += origins;
  }
  return {};
}

/// By distortion, and by the cell whose view is taken: each view is then asked for by one chunk
/// only, and counted once, as in a call in-process.
Status divide(Scoring& scoring) {
  std::vector<similarity::AffineGroup> groups;
  if (scoring.request.affines.empty()) {
    groups.push_back({{}, {}, scoring.request});
  } else {
    SEMVIEW_TRY(groups, similarity::group_by_affine(scoring.request));
  }
  const service::Site& site = *scoring.site;
  for (similarity::AffineGroup& group : groups) {
    ScorePart& part = scoring.parts.emplace_back(std::move(group), site.views());
    SEMVIEW_TRY(part.batch, similarity::unscored_batch(*scoring.prepared, part.group.request));
    SEMVIEW_TRY(
        part.cells,
        similarity::group_by_cell(
            part.group.request.poses, part.group.request.mode, [&site](const CellIndex& cell) {
              return site.cells().view_cell(cell).value_or(cell);
            }));
  }
  return {};
}

/// Chunks of at most `kCellsPerChunk` cells, of several parts where those are small.
std::vector<Chunk> cut_cells(const std::shared_ptr<Scoring>& scoring, ThreadPool& pool) {
  std::vector<Chunk> chunks;
  std::vector<Piece> pieces;
  std::size_t cells = 0;
  const auto close = [&] {
    if (pieces.empty()) return;
    chunks.push_back(
        {cells, [scoring, pieces, &pool] { return score_pieces(*scoring, pieces, pool); }});
    pieces.clear();
    cells = 0;
  };
  for (ScorePart& part : scoring->parts) {
    const std::size_t count = part.cells.cells.size();
    for (std::size_t begin = 0; begin < count;) {
      const std::size_t end = std::min(begin + kCellsPerChunk - cells, count);
      pieces.push_back({&part, {begin, end}});
      cells += end - begin;
      begin = end;
      if (cells == kCellsPerChunk) close();
    }
  }
  close();
  return chunks;
}

Result<ScoreBatch> collect(Scoring& scoring) {
  if (scoring.request.affines.empty()) return std::move(scoring.parts.front().batch);
  SEMVIEW_TRY(ScoreBatch whole, similarity::unscored_batch(*scoring.prepared, scoring.request));
  for (const ScorePart& part : scoring.parts) {
    similarity::put_scores(part.batch, part.group, whole);
  }
  return whole;
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

/// The panorama of a request that has one.
/// @errors those of its fields
Result<SharedObservation> prepare_labels(Services& services,
                                         const service::Site& site,
                                         const v1::SetObservationRequest& wire) {
  SEMVIEW_TRY(const Observation observation, protocol::from_wire(wire));
  const PanoramaCamera& camera = site.profile().camera;
  if (observation.labels.rows() != camera.rows || observation.labels.columns() != camera.columns) {
    return protocol::wrong_field("labels",
                                 fmt::format("{} rows × {} columns; expected {} × {}, the map's",
                                             observation.labels.rows(),
                                             observation.labels.columns(),
                                             camera.rows,
                                             camera.columns));
  }
  SEMVIEW_TRY(const SharedWeights weights,
              read_weights(services, wire.weights_csv(), site.map().classes));
  Result<similarity::PreparedObservation> prepared =
      similarity::PreparedObservation::build(observation, *weights, site.map().classes, camera);
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
  return std::make_shared<const similarity::PreparedObservation>(*std::move(prepared));
}

/// What a depth camera saw, as voxels; null in a request without.
/// @errors those of its fields
Result<std::shared_ptr<const VoxelList>> read_voxels(const v1::SetObservationRequest& wire) {
  if (wire.has_voxels() && wire.has_depth()) {
    return protocol::wrong_field("depth", "comes with `voxels`; expected one of them");
  }
  if (!wire.has_voxels() && !wire.has_depth()) return nullptr;
  SEMVIEW_TRY(ClassTable classes, protocol::classes_from_wire(wire));
  if (wire.has_voxels()) {
    SEMVIEW_TRY(VoxelList list, protocol::from_wire(wire.voxels(), classes, wire.stamp_s()));
    return std::make_shared<const VoxelList>(std::move(list));
  }
  SEMVIEW_TRY(const DepthObservation seen,
              protocol::from_wire(wire.depth(), classes, wire.stamp_s()));
  observation::VoxelReductionConfig config;
  if (wire.depth().voxel_m() != 0.0) config.voxel_m = wire.depth().voxel_m();
  if (wire.depth().max_depth_m() != 0.0) config.max_depth_m = wire.depth().max_depth_m();
  Result<VoxelList> list = observation::reduce(seen, config);
  if (!list) return protocol::wrong_field("depth", list.error().message);
  return std::make_shared<const VoxelList>(*std::move(list));
}

}  // namespace

std::size_t most_poses(const service::Limits& limits, const v1::ScoreRequest& wire) {
  std::size_t most = limits.max_poses;
  if (wire.whole_curve()) most = std::min(most, limits.max_curve_poses);
  if (wire.affines().a_size() > 0) most = std::min(most, limits.max_distorted_poses);
  return most;
}

Result<Plan> plan_set_observation(Services& services, const Request& request) {
  SEMVIEW_TRY(const auto wire, protocol::parse<v1::SetObservationRequest>(request.body, "body"));
  SEMVIEW_TRY(const SharedSite site, find_site(services, wire.map_id(), wire.fingerprint()));
  service::StoredObservation stored;
  stored.map_id = site->id();
  SEMVIEW_TRY(stored.voxels, read_voxels(wire));
  v1::SetObservationReply reply;
  std::uint64_t bytes = 0;
  const bool only_depth =
      stored.voxels != nullptr && wire.labels().empty() && wire.rows() == 0 && wire.columns() == 0;
  if (!only_depth) {
    SEMVIEW_TRY(stored.prepared, prepare_labels(services, *site, wire));
    reply.set_weight_scale(stored.prepared->weight_scale());
    reply.set_observed_pixels(stored.prepared->observed_pixels());
    bytes += stored.prepared->byte_size();
  }
  if (stored.voxels != nullptr) {
    reply.set_observed_voxels(static_cast<std::uint32_t>(stored.voxels->voxels.size()));
    bytes += stored.voxels->voxels.size() * sizeof(ObservedVoxel);
  }
  SEMVIEW_TRY(const std::uint64_t number,
              services.observations.add(request.client, std::move(stored), bytes));
  reply.set_observation_id(wire_id(services, number));
  return answer(reply.SerializeAsString());
}

Result<Plan> plan_score(Services& services, const Request& request) {
  SEMVIEW_TRY(const auto wire, protocol::parse<v1::ScoreRequest>(request.body, "body"));
  const auto scoring = std::make_shared<Scoring>();
  SEMVIEW_TRY(scoring->site, find_site(services, wire.map_id(), wire.fingerprint()));
  SEMVIEW_TRY(const service::StoredObservation stored,
              find_observation(services, wire.observation_id(), wire.map_id()));
  SEMVIEW_TRY(const ScoreModel model, protocol::from_wire(wire.model()));
  if (scores_depth(model)) {
    SEMVIEW_TRY(DepthModel depth,
                depth_model(services, *scoring->site, stored, model, wire.scoring()));
    return plan_depth_score(services, request, std::move(depth), wire);
  }
  SEMVIEW_TRY(scoring->prepared, labels_of(stored));
  SEMVIEW_TRY(scoring->request, protocol::from_wire(wire, most_poses(services.limits, wire)));
  SEMVIEW_TRY_STATUS(divide(*scoring));

  Plan plan;
  plan.chunks = cut_cells(scoring, services.inline_pool);
  SEMVIEW_TRY_STATUS(check_queue(services, request, plan.chunks.size() * kCellsPerChunk, "poses"));
  plan.finish = [scoring]() -> Result<std::string> {
    SEMVIEW_TRY(const ScoreBatch batch, collect(*scoring));
    return protocol::to_wire(batch).SerializeAsString();
  };
  return plan;
}

}  // namespace semview::server
