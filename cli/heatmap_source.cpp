// SPDX-License-Identifier: Apache-2.0
#include "heatmap_source.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "client/lib/remote_score_source.hpp"
#include "plan_backdrop.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/observation/cell_posterior.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "server_option.hpp"
#include "weights_option.hpp"

namespace semview::cli {
namespace {

/// A whole floor whose views a server has to cast first; what servers allow by default.
constexpr std::chrono::minutes kPatience{10};

bool show_progress(std::size_t done, std::size_t cells) {
  fmt::print(stderr, "\r{} of {} cells{}", done, cells, done == cells ? "\n" : "");
  return true;
}

Result<HeatMapOfMap> from_site(const HeatMapInputs& inputs,
                               const client::HeatMapQuestion& question) {
  SEMVIEW_TRY(const std::shared_ptr<service::Site> site, open_site(inputs.site));
  const map::SemanticMap& map = site->map();
  SEMVIEW_TRY(const Observation observation, read(inputs.observation, site->profile().camera));
  SEMVIEW_TRY(const similarity::WeightMatrix weights,
              read_weights(inputs.weights, observation.classes, map.classes));
  SEMVIEW_TRY(const similarity::PreparedObservation prepared,
              similarity::PreparedObservation::build(
                  observation, weights, map.classes, site->profile().camera));
  similarity::CellWeight cell_weight;
  if (question.posterior) {
    cell_weight = [config = *question.posterior](std::span<const double> similarities) {
      return observation::cell_log_weight(config, similarities);
    };
  }
  const std::vector<CellIndex> cells = site->cells().free_cells();
  HeatMapOfMap made;
  SEMVIEW_TRY(
      made.answer.heat,
      similarity::heat_map(prepared,
                           site->views(),
                           cells,
                           question.headings,
                           site->pool(),
                           isatty(STDERR_FILENO) != 0
                               ? std::function<bool(std::size_t, std::size_t)>(show_progress)
                               : nullptr,
                           cell_weight));
  if (question.posterior) {
    const Image<double>& log_weight = made.answer.heat.log_weight;
    SEMVIEW_TRY(const std::vector<float> probabilities,
                observation::cell_probabilities(log_weight.pixels()));
    made.answer.probability = Image<float>(log_weight.rows(), log_weight.columns());
    std::ranges::copy(probabilities, made.answer.probability.pixels().begin());
  }
  made.cells = cells.size();
  made.id = site->id();
  made.name = map.name;
  made.fingerprint = map.fingerprint;
  made.engine = site->engine().name;
  made.engine_reason = site->engine().reason;
  if (map.columns() != nullptr) {  // of a mesh the values themselves show the free cells
    if (Result<picture::Plan> plan = plan_backdrop(map)) made.plan = *std::move(plan);
  }
  return made;
}

Result<HeatMapOfMap> from_server(const HeatMapInputs& inputs,
                                 const client::HeatMapQuestion& question) {
  SEMVIEW_TRY(const client::ConnectionConfig config,
              connection_to(inputs.server, "heatmap", kPatience));
  SEMVIEW_TRY(client::Connection connection, client::Connection::open(config));
  SEMVIEW_TRY(const protocol::MapDescription map, client::get_map(connection, inputs.site.map));
  SEMVIEW_TRY(const Observation observation, read(inputs.observation, map.profile.camera));
  SEMVIEW_TRY(similarity::WeightMatrix weights,
              read_weights(inputs.weights, observation.classes, map.classes));
  SEMVIEW_TRY(const auto source,
              client::RemoteScoreSource::open(config, inputs.site.map, std::move(weights)));
  SEMVIEW_TRY_STATUS(source->set_observation(observation));
  HeatMapOfMap made;
  SEMVIEW_TRY(made.answer, source->heat_map(question));
  made.cells = map.free_cells.size();
  made.id = map.summary.id;
  made.name = map.summary.name;
  made.fingerprint = map.summary.fingerprint;
  made.engine = map.engine;
  made.engine_reason = map.engine_reason;
  return made;
}

}  // namespace

Result<HeatMapOfMap> heat_map_of(const HeatMapInputs& inputs,
                                 const client::HeatMapQuestion& question) {
  return inputs.server.empty() ? from_site(inputs, question) : from_server(inputs, question);
}

}  // namespace semview::cli
