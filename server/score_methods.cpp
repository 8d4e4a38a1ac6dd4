// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <mutex>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "methods.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/score_wire.hpp"
#include "semview/protocol/view_wire.hpp"
#include "semview/similarity/heat_map.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "semview/similarity/score_poses.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace semview::server {
namespace {

using Prepared = std::shared_ptr<const similarity::PreparedObservation>;
using SharedSite = std::shared_ptr<service::Site>;

/// @errors kNotFound: unknown, dropped, or of another start of the server; kInvalidArgument: set
/// for another map.
Result<Prepared> find_observation(Services& services,
                                  const std::string& id,
                                  const std::string& map_id) {
  constexpr std::string_view kField = "observation_id";
  SEMVIEW_TRY(const std::uint64_t number, number_of(services, id, kField));
  Result<service::StoredObservation> stored = services.observations.find(number);
  if (!stored) {
    Error error = std::move(stored).error();
    error.field = kField;
    return fail(std::move(error));
  }
  if (stored->map_id != map_id) {
    return protocol::wrong_field(
        kField, fmt::format("was set for map '{}', not '{}'", stored->map_id, map_id));
  }
  return stored->prepared;
}

/// One Score request, its poses in order of their cells and cut between cells.
struct Scoring {
  SharedSite site;
  Prepared prepared;
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

/// Cuts the ordered poses into chunks of whole cells.
std::vector<Chunk> cut_poses(const std::shared_ptr<Scoring>& scoring,
                             const std::vector<CellIndex>& cells,
                             ThreadPool& pool) {
  std::vector<Chunk> chunks;
  const std::size_t count = scoring->order.size();
  std::size_t begin = 0;
  std::size_t distinct = 0;
  for (std::size_t i = 0; i < count; ++i) {
    distinct += i == begin || cells[scoring->order[i]] != cells[scoring->order[i - 1]] ? 1 : 0;
    const bool last_of_cell =
        i + 1 == count || cells[scoring->order[i + 1]] != cells[scoring->order[i]];
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

/// The best of the heat map's cells so far.
struct HeatMapping {
  SharedSite site;
  Prepared prepared;
  std::vector<CellIndex> cells;
  int headings = PoseGrid::kHeadings;
  CellIndex origin;
  int columns = 0;
  int rows = 0;
  std::vector<float> similarity;
  std::string best_headings;
  std::mutex mutex;  ///< guards origins
  ViewOrigins origins;
};

Status heat_part(HeatMapping& heat, std::size_t begin, std::size_t end, ThreadPool& pool) {
  const std::span<const CellIndex> cells = std::span(heat.cells).subspan(begin, end - begin);
  SEMVIEW_TRY(const similarity::HeatMap part,
              similarity::heat_map(*heat.prepared, heat.site->views(), cells, heat.headings, pool));
  for (const CellIndex& cell : cells) {
    const auto to = static_cast<std::size_t>(cell.iy - heat.origin.iy) *
                        static_cast<std::size_t>(heat.columns) +
                    static_cast<std::size_t>(cell.ix - heat.origin.ix);
    const int row = cell.iy - part.origin.iy;
    const int column = cell.ix - part.origin.ix;
    heat.similarity[to] = part.similarity.at(row, column);
    heat.best_headings[to] = static_cast<char>(part.best_heading.at(row, column));
  }
  const std::lock_guard lock(heat.mutex);
  heat.origins += part.origins;
  return {};
}

/// The free cells of a map whose centre is in the region, row by row.
Result<std::vector<CellIndex>> heat_cells(const Services& services,
                                          const service::Site& site,
                                          const v1::HeatmapRequest& wire) {
  std::vector<CellIndex> cells = site.cells().free_cells();
  if (wire.has_region()) {
    const v1::Region& region = wire.region();
    // Written so that NaN fails.
    if (!(region.x_min_m() < region.x_max_m() && region.y_min_m() < region.y_max_m())) {
      return protocol::wrong_field("region", "the minimum must be below the maximum");
    }
    std::erase_if(cells, [&region](const CellIndex& cell) {
      const Pose2 center = PoseGrid::center(cell);
      return center.x_m < region.x_min_m() || center.x_m > region.x_max_m() ||
             center.y_m < region.y_min_m() || center.y_m > region.y_max_m();
    });
  }
  if (cells.empty()) return protocol::wrong_field("region", "holds no free cell of the map");
  if (cells.size() > services.limits.max_heat_map_cells) {
    return fail(Error{ErrorCode::kResourceExhausted,
                      fmt::format("region: {} free cells; at most {} in one request",
                                  cells.size(),
                                  services.limits.max_heat_map_cells),
                      "region",
                      "ask for parts of the map"});
  }
  return cells;
}

/// Refuses work for which the queue has no room.
Status check_queue(const Services& services, std::size_t cells, std::string_view field) {
  const std::uint64_t waiting = services.queued_cells();
  if (waiting + cells <= services.limits.max_queued_cells) return {};
  return fail(Error{ErrorCode::kResourceExhausted,
                    fmt::format("{}: {} cells on top of the {} that wait are more than {}",
                                field,
                                cells,
                                waiting,
                                services.limits.max_queued_cells),
                    std::string(field),
                    "the server is busy: send it again later",
                    kRetryAfter_ms});
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
  const auto weights = wire.weights_csv().empty()
                           ? Result<similarity::WeightMatrix>(
                                 similarity::WeightMatrix::identity(site->map().classes))
                           : similarity::parse_weight_matrix(wire.weights_csv(), "weights_csv");
  const auto prepared = weights ? similarity::PreparedObservation::build(
                                      observation, *weights, site->map().classes, camera)
                                : Result<similarity::PreparedObservation>(fail(weights.error()));
  if (!prepared) {
    Error error = prepared.error();
    const bool in_weights = !weights || error.code == ErrorCode::kFailedPrecondition;
    if (in_weights || error.field.empty()) error.field = in_weights ? "weights_csv" : "labels";
    return fail(std::move(error));
  }
  const auto shared = std::make_shared<const similarity::PreparedObservation>(*prepared);
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
  std::vector<CellIndex> cells(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto cell = PoseGrid::cell(poses[i].x_m, poses[i].y_m);
    if (!cell) return protocol::wrong_field("poses", fmt::format("entry {} has no cell", i));
    cells[i] = scoring->site->cells().view_cell(*cell).value_or(*cell);
  }
  scoring->order.resize(poses.size());
  std::iota(scoring->order.begin(), scoring->order.end(), std::size_t{0});
  std::sort(scoring->order.begin(), scoring->order.end(), [&cells](std::size_t a, std::size_t b) {
    return cells[a] != cells[b] ? cells[a] < cells[b] : a < b;
  });

  ScoreBatch& batch = scoring->batch;
  batch.weight_scale = scoring->prepared->weight_scale();
  batch.observed_pixels = scoring->prepared->observed_pixels();
  batch.sums.resize(poses.size());
  if (scoring->request.mode == HeadingMode::kCompass) batch.best_heading.resize(poses.size());
  if (scoring->request.whole_curve) batch.curve.resize(poses.size() * PoseGrid::kHeadings);

  Plan plan;
  plan.chunks = cut_poses(scoring, cells, services.inline_pool);
  SEMVIEW_TRY_STATUS(check_queue(services, plan.chunks.size() * kCellsPerChunk, "poses"));
  plan.finish = [scoring]() -> Result<std::string> {
    return protocol::to_wire(scoring->batch).SerializeAsString();
  };
  return plan;
}

Result<Plan> plan_heatmap(Services& services, const Request& request) {
  SEMVIEW_TRY(const auto wire, protocol::parse<v1::HeatmapRequest>(request.body, "body"));
  const auto heat = std::make_shared<HeatMapping>();
  SEMVIEW_TRY(heat->site, find_site(services, wire.map_id(), wire.fingerprint()));
  SEMVIEW_TRY(heat->prepared, find_observation(services, wire.observation_id(), wire.map_id()));
  const std::uint32_t headings = wire.headings() == 0 ? PoseGrid::kHeadings : wire.headings();
  if (headings > PoseGrid::kHeadings || PoseGrid::kHeadings % headings != 0) {
    return protocol::wrong_field("headings",
                                 fmt::format("{}; expected a divisor of 120", headings));
  }
  heat->headings = static_cast<int>(headings);
  SEMVIEW_TRY(heat->cells, heat_cells(services, *heat->site, wire));
  SEMVIEW_TRY_STATUS(check_queue(services, heat->cells.size(), "region"));

  const auto by_ix = [](const CellIndex& a, const CellIndex& b) { return a.ix < b.ix; };
  const auto [west, east] = std::minmax_element(heat->cells.begin(), heat->cells.end(), by_ix);
  heat->origin = {west->ix, heat->cells.front().iy};
  heat->columns = east->ix - west->ix + 1;
  heat->rows = heat->cells.back().iy - heat->cells.front().iy + 1;
  const std::size_t pixels =
      static_cast<std::size_t>(heat->columns) * static_cast<std::size_t>(heat->rows);
  heat->similarity.assign(pixels, std::numeric_limits<float>::quiet_NaN());
  heat->best_headings.assign(pixels, static_cast<char>(0xff));

  Plan plan;
  for (std::size_t begin = 0; begin < heat->cells.size(); begin += kCellsPerChunk) {
    const std::size_t end = std::min(begin + kCellsPerChunk, heat->cells.size());
    plan.chunks.push_back({end - begin, [heat, begin, end, &pool = services.inline_pool] {
                             return heat_part(*heat, begin, end, pool);
                           }});
  }
  plan.finish = [heat]() -> Result<std::string> {
    v1::HeatmapReply reply;
    reply.set_rows(static_cast<std::uint32_t>(heat->rows));
    reply.set_columns(static_cast<std::uint32_t>(heat->columns));
    reply.set_origin_ix(heat->origin.ix);
    reply.set_origin_iy(heat->origin.iy);
    reply.mutable_similarity()->Add(heat->similarity.begin(), heat->similarity.end());
    reply.set_best_headings(std::move(heat->best_headings));
    *reply.mutable_origins() = protocol::to_wire(heat->origins);
    return reply.SerializeAsString();
  };
  return plan;
}

}  // namespace semview::server
