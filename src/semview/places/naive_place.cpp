// SPDX-License-Identifier: Apache-2.0
#include "semview/places/naive_place.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/similarity/heat_map.hpp"
#include "semview/similarity/weight_proposal.hpp"

namespace semview::places {
namespace {

Result<similarity::WeightMatrix> same_class_weights(const ClassTable& observed,
                                                    const map::SemanticMap& map) {
  const similarity::SynonymTable& synonyms = similarity::SynonymTable::shipped();
  std::vector<std::string> columns{std::string(similarity::kNoneColumn)};
  similarity::WeightMatrix::Band band;
  for (const std::string& name : map.classes.names()) columns.push_back(name);
  for (const std::string& seen : observed.names()) {
    band.weights.push_back(0.0);
    for (const map::MapClass& drawn : map.class_details) {
      const bool same = similarity::share_a_name({seen, {}}, {drawn.name, drawn.aliases}) ||
                        (synonyms.contains(seen) &&
                         synonyms.score(seen, drawn.name) >= synonyms.significance(seen));
      band.weights.push_back(same ? 1.0 : 0.0);
    }
  }
  return similarity::WeightMatrix::build(
      {observed.names().begin(), observed.names().end()}, std::move(columns), {std::move(band)});
}

}  // namespace

Result<std::optional<Pose2>> naive_place(const service::Site& floor,
                                         const Observation& observation) {
  SEMVIEW_TRY(const similarity::WeightMatrix weights,
              same_class_weights(observation.classes, floor.map()));
  SEMVIEW_TRY(const similarity::PreparedObservation prepared,
              similarity::PreparedObservation::build(
                  observation, weights, floor.map().classes, floor.profile().camera));
  SEMVIEW_TRY(
      const similarity::HeatMap heat,
      similarity::heat_map(
          prepared, floor.views(), floor.cells().free_cells(), PoseGrid::kHeadings, floor.pool()));
  const GridKey best = heat.best();
  const float similarity =
      heat.similarity.at(best.cell.iy - heat.origin.iy, best.cell.ix - heat.origin.ix);
  if (std::isnan(similarity)) return std::optional<Pose2>{};
  return std::optional<Pose2>(PoseGrid::center(best) * inverse(observation.base_from_eye));
}

}  // namespace semview::places
