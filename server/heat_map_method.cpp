// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "methods.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/observation/cell_posterior.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/view_wire.hpp"
#include "semview/similarity/heat_map.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "semview/v1/scores.pb.h"

namespace semview::server {
namespace {

/// The best of the heat map's cells so far.
struct HeatMapping {
  std::shared_ptr<service::Site> site;
  SharedObservation prepared;
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
};

Status heat_part(HeatMapping& heat, std::size_t begin, std::size_t end, ThreadPool& pool) {
  const std::span<const CellIndex> cells = std::span(heat.cells).subspan(begin, end - begin);
  SEMVIEW_TRY(
      const similarity::HeatMap part,
      similarity::heat_map(
          *heat.prepared, heat.site->views(), cells, heat.headings, pool, {}, heat.cell_weight));
  for (const CellIndex& cell : cells) {
    const auto to = static_cast<std::size_t>(cell.iy - heat.origin.iy) *
                        static_cast<std::size_t>(heat.columns) +
                    static_cast<std::size_t>(cell.ix - heat.origin.ix);
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

Result<similarity::CellWeight> cell_weight(const v1::Weighting& wire) {
  observation::SimilarityWeightingConfig config;
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

}  // namespace

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
  if (wire.has_posterior()) {
    SEMVIEW_TRY(heat->cell_weight, cell_weight(wire.posterior()));
  }
  SEMVIEW_TRY(heat->cells, heat_cells(services, *heat->site, wire));
  SEMVIEW_TRY_STATUS(check_queue(services, request, heat->cells.size(), "region"));

  const auto by_ix = [](const CellIndex& a, const CellIndex& b) { return a.ix < b.ix; };
  const auto [west, east] = std::minmax_element(heat->cells.begin(), heat->cells.end(), by_ix);
  heat->origin = {west->ix, heat->cells.front().iy};
  heat->columns = east->ix - west->ix + 1;
  heat->rows = heat->cells.back().iy - heat->cells.front().iy + 1;
  const std::size_t pixels =
      static_cast<std::size_t>(heat->columns) * static_cast<std::size_t>(heat->rows);
  heat->similarity.assign(pixels, std::numeric_limits<float>::quiet_NaN());
  heat->best_headings.assign(pixels, static_cast<char>(0xff));
  if (heat->cell_weight) {
    heat->log_weight.assign(pixels, std::numeric_limits<double>::quiet_NaN());
  }

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
    if (heat->cell_weight) {
      SEMVIEW_TRY(const std::vector<float> probability,
                  observation::cell_probabilities(heat->log_weight));
      reply.mutable_probability()->Add(probability.begin(), probability.end());
    }
    *reply.mutable_origins() = protocol::to_wire(heat->origins);
    return reply.SerializeAsString();
  };
  return plan;
}

}  // namespace semview::server
