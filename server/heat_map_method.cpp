// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "depth_methods.hpp"
#include "methods.hpp"
#include "semview/field/field_score_source.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/observation/cell_posterior.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/model_wire.hpp"
#include "semview/protocol/view_wire.hpp"
#include "semview/similarity/heat_map.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "semview/v1/scores.pb.h"

namespace semview::server {
namespace {

/// The best of the heat map's cells so far.
struct HeatMapping {
  std::shared_ptr<service::Site> site;
  SharedObservation prepared;  ///< null where depth is scored
  DepthModel depth;
  std::vector<CellIndex> cells;
  int headings = PoseGrid::kHeadings;
  CellIndex origin;
  int columns = 0;
  int rows = 0;
  similarity::CellWeight cell_weight;  ///< empty: no probabilities are asked for
  std::vector<float> similarity;
  std::vector<double> log_weight;  ///< empty without `cell_weight`
  std::string best_headings;
  std::mutex mutex;  ///< guards origins
  ViewOrigins origins;

  /// Where a cell is in the arrays.
  std::size_t place_of(const CellIndex& cell) const {
    return static_cast<std::size_t>(cell.iy - origin.iy) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(cell.ix - origin.ix);
  }
};

Result<similarity::HeatMap> heat_of(const HeatMapping& heat,
                                    std::span<const CellIndex> cells,
                                    ThreadPool& pool) {
  if (heat.prepared != nullptr) {
    return similarity::heat_map(
        *heat.prepared, heat.site->views(), cells, heat.headings, pool, {}, heat.cell_weight);
  }
  field::FieldScoreSource source(
      heat.depth.likelihood, heat.depth.observation, heat.site->profile(), pool);
  return similarity::heat_map(
      source, cells, similarity::even_headings(heat.headings), {}, heat.cell_weight);
}

Status heat_part(HeatMapping& heat, std::size_t begin, std::size_t end, ThreadPool& pool) {
  const std::span<const CellIndex> cells = std::span(heat.cells).subspan(begin, end - begin);
  SEMVIEW_TRY(const similarity::HeatMap part, heat_of(heat, cells, pool));
  for (const CellIndex& cell : cells) {
    const std::size_t to = heat.place_of(cell);
    const int row = cell.iy - part.origin.iy;
    const int column = cell.ix - part.origin.ix;
    heat.similarity[to] = part.similarity.at(row, column);
    heat.best_headings[to] = static_cast<char>(part.best_heading.at(row, column));
    if (heat.cell_weight) heat.log_weight[to] = part.log_weight.at(row, column);
  }
  const std::lock_guard lock(heat.mutex);
  heat.origins += part.origins;
  return {};
}

/// @errors kInvalidArgument: out of range; a power of the logarithms that models of depth give.
Result<similarity::CellWeight> cell_weight(const v1::Weighting& wire, bool of_depth) {
  observation::SimilarityWeightingConfig config;
  if (of_depth) {
    if (wire.has_power()) {
      return protocol::wrong_field("posterior.power",
                                   "similarities of depth are logarithms; expected kappa");
    }
    config.transform = observation::WeightTransform::kExponential;
    config.kappa = kDepthKappa;
  }
  if (wire.has_power()) config.power = wire.power();
  if (wire.has_kappa()) {
    config.transform = observation::WeightTransform::kExponential;
    config.kappa = wire.kappa();
  }
  if (const Status valid = validate(config); !valid) {
    return protocol::wrong_field("posterior." + valid.error().field, valid.error().message);
  }
  return [config](std::span<const double> similarities) {
    return observation::cell_log_weight(config, similarities);
  };
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

/// What is asked of which cells.
/// @errors those of the request's fields
Result<std::shared_ptr<HeatMapping>> read_heat_map(Services& services,
                                                   const v1::HeatmapRequest& wire) {
  auto heat = std::make_shared<HeatMapping>();
  SEMVIEW_TRY(heat->site, find_site(services, wire.map_id(), wire.fingerprint()));
  SEMVIEW_TRY(const service::StoredObservation stored,
              find_observation(services, wire.observation_id(), wire.map_id()));
  SEMVIEW_TRY(const ScoreModel model, protocol::from_wire(wire.model()));
  const std::uint32_t headings = wire.headings() == 0 ? PoseGrid::kHeadings : wire.headings();
  if (headings > PoseGrid::kHeadings || PoseGrid::kHeadings % headings != 0) {
    return protocol::wrong_field("headings",
                                 fmt::format("{}; expected a divisor of 120", headings));
  }
  heat->headings = static_cast<int>(headings);
  if (wire.has_posterior()) {
    SEMVIEW_TRY(heat->cell_weight, cell_weight(wire.posterior(), scores_depth(model)));
  }
  SEMVIEW_TRY(heat->cells, heat_cells(services, *heat->site, wire));
  if (scores_depth(model)) {
    SEMVIEW_TRY(heat->depth, depth_model(services, *heat->site, stored, model, wire.scoring()));
  } else {
    SEMVIEW_TRY(heat->prepared, labels_of(stored));
  }
  return heat;
}

/// Room for what is found, on the cells' bounding box.
void make_room(HeatMapping& heat) {
  const auto by_ix = [](const CellIndex& a, const CellIndex& b) { return a.ix < b.ix; };
  const auto [west, east] = std::minmax_element(heat.cells.begin(), heat.cells.end(), by_ix);
  heat.origin = {west->ix, heat.cells.front().iy};
  heat.columns = east->ix - west->ix + 1;
  heat.rows = heat.cells.back().iy - heat.cells.front().iy + 1;
  const std::size_t pixels =
      static_cast<std::size_t>(heat.columns) * static_cast<std::size_t>(heat.rows);
  heat.similarity.assign(pixels, std::numeric_limits<float>::quiet_NaN());
  heat.best_headings.assign(pixels, static_cast<char>(0xff));
  if (heat.cell_weight) {
    heat.log_weight.assign(pixels, std::numeric_limits<double>::quiet_NaN());
  }
}

Result<std::string> heat_reply(HeatMapping& heat) {
  v1::HeatmapReply reply;
  reply.set_rows(static_cast<std::uint32_t>(heat.rows));
  reply.set_columns(static_cast<std::uint32_t>(heat.columns));
  reply.set_origin_ix(heat.origin.ix);
  reply.set_origin_iy(heat.origin.iy);
  reply.mutable_similarity()->Add(heat.similarity.begin(), heat.similarity.end());
  reply.set_best_headings(std::move(heat.best_headings));
  if (heat.cell_weight) {
    SEMVIEW_TRY(const std::vector<float> probability,
                observation::cell_probabilities(heat.log_weight));
    reply.mutable_probability()->Add(probability.begin(), probability.end());
  }
  *reply.mutable_origins() = protocol::to_wire(heat.origins);
  return reply.SerializeAsString();
}

}  // namespace

Result<Plan> plan_heatmap(Services& services, const Request& request) {
  SEMVIEW_TRY(const auto wire, protocol::parse<v1::HeatmapRequest>(request.body, "body"));
  SEMVIEW_TRY(const std::shared_ptr<HeatMapping> heat, read_heat_map(services, wire));
  const bool of_depth = heat->prepared == nullptr;
  // A cell of views takes about as long as a pose of depth.
  const auto each = static_cast<std::size_t>(!of_depth           ? 1
                                             : heat->cell_weight ? PoseGrid::kHeadings
                                                                 : heat->headings);
  SEMVIEW_TRY_STATUS(check_queue(services, request, heat->cells.size() * each, "region"));
  make_room(*heat);

  Plan plan;
  const std::size_t at_once =
      of_depth ? std::max<std::size_t>(kPosesPerChunk / each, 1) : kCellsPerChunk;
  for (std::size_t begin = 0; begin < heat->cells.size(); begin += at_once) {
    const std::size_t end = std::min(begin + at_once, heat->cells.size());
    plan.chunks.push_back({(end - begin) * each, [heat, begin, end, &pool = services.inline_pool] {
                             return heat_part(*heat, begin, end, pool);
                           }});
  }
  plan.finish = [heat] { return heat_reply(*heat); };
  return plan;
}

}  // namespace semview::server
