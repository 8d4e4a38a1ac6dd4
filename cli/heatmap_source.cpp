// SPDX-License-Identifier: Apache-2.0
#include "heatmap_source.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "client/lib/remote_score_source.hpp"
#include "log_depths.hpp"
#include "plan_backdrop.hpp"
#include "semview/field/field_score_source.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/observation/cell_posterior.hpp"
#include "semview/service/field_likelihoods.hpp"
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

using Progress = std::function<bool(std::size_t, std::size_t)>;

Progress progress() { return isatty(STDERR_FILENO) != 0 ? Progress(show_progress) : nullptr; }

ModelOptions options_of(const HeatMapInputs& inputs, const std::string& model) {
  ModelOptions options = inputs.depth;
  options.model = model;
  return options;
}

/// What a model compares, and where it was seen from if the log says so.
struct Seen {
  Observation observation;
  std::optional<Pose2> truth;
};

Result<Seen> seen_by_depth(const ObservationOption& option, const ModelOptions& model) {
  SEMVIEW_TRY(const io::RunLog log, read_log_of(option));
  SEMVIEW_TRY(const std::optional<LogDepths> depths, open_log_depths(log, model));
  SEMVIEW_TRY(std::optional<Observation> observation, depths->observe(*option.frame, {}));
  if (!observation) {
    return fail(Error{
        ErrorCode::kInvalidArgument,
        fmt::format("--frame {}: shows nothing that model {} looks at", *option.frame, model.model),
        "--frame"});
  }
  return Seen{*std::move(observation), true_pose(log, *option.frame)};
}

Result<Seen> seen_by(const HeatMapInputs& inputs,
                     const ModelOptions& model,
                     const PanoramaCamera& profile) {
  if (scores_depth(model)) return seen_by_depth(inputs.observation, model);
  Seen seen;
  SEMVIEW_TRY(seen.observation, read(inputs.observation, profile));
  if (inputs.observation.frame) {
    SEMVIEW_TRY(const io::RunLog log, read_log_of(inputs.observation));
    seen.truth = true_pose(log, *inputs.observation.frame);
    if (seen.truth) seen.truth = *seen.truth * seen.observation.base_from_eye;
  }
  return seen;
}

similarity::CellWeight cell_weight_of(const client::HeatMapQuestion& question) {
  if (!question.posterior) return {};
  return [config = *question.posterior](std::span<const double> similarities) {
    return observation::cell_log_weight(config, similarities);
  };
}

Result<similarity::HeatMap> heat_of_views(const HeatMapInputs& inputs,
                                          const Observation& observation,
                                          const service::Site& site,
                                          const client::HeatMapQuestion& question) {
  const map::SemanticMap& map = site.map();
  SEMVIEW_TRY(const similarity::WeightMatrix weights,
              read_weights(inputs.weights, observation.classes, map.classes));
  SEMVIEW_TRY(const similarity::PreparedObservation prepared,
              similarity::PreparedObservation::build(
                  observation, weights, map.classes, site.profile().camera));
  return similarity::heat_map(prepared,
                              site.views(),
                              site.cells().free_cells(),
                              question.headings,
                              site.pool(),
                              progress(),
                              cell_weight_of(question));
}

Result<similarity::HeatMap> heat_of_depth(const ModelOptions& model,
                                          const std::optional<double>& heading_yaw_rad,
                                          const Observation& observation,
                                          const service::Site& site,
                                          const client::HeatMapQuestion& question) {
  SEMVIEW_TRY(const auto likelihood, site.likelihoods().of(depth_scoring(model)));
  field::FieldScoreSource source(likelihood, site.profile(), site.pool());
  SEMVIEW_TRY_STATUS(source.set_observation(observation));
  const std::vector<int> headings = heading_yaw_rad
                                        ? std::vector{PoseGrid::heading(*heading_yaw_rad)}
                                        : similarity::even_headings(question.headings);
  return similarity::heat_map(
      source, site.cells().free_cells(), headings, progress(), cell_weight_of(question));
}

Status add_probability(client::HeatMapAnswer& answer) {
  const Image<double>& log_weight = answer.heat.log_weight;
  SEMVIEW_TRY(const std::vector<float> probabilities,
              observation::cell_probabilities(log_weight.pixels()));
  answer.probability = Image<float>(log_weight.rows(), log_weight.columns());
  std::ranges::copy(probabilities, answer.probability.pixels().begin());
  return {};
}

Result<HeatMapOfMap> from_site(const HeatMapInputs& inputs,
                               const std::string& model,
                               const service::Site& site,
                               const client::HeatMapQuestion& question) {
  const ModelOptions options = options_of(inputs, model);
  SEMVIEW_TRY(const Seen seen, seen_by(inputs, options, site.profile().camera));
  HeatMapOfMap made;
  SEMVIEW_TRY(made.answer.heat,
              scores_depth(options)
                  ? heat_of_depth(options, inputs.heading_yaw_rad, seen.observation, site, question)
                  : heat_of_views(inputs, seen.observation, site, question));
  if (question.posterior) SEMVIEW_TRY_STATUS(add_probability(made.answer));
  const map::SemanticMap& map = site.map();
  made.cells = site.cells().free_cells().size();
  made.id = site.id();
  made.name = map.name;
  made.fingerprint = map.fingerprint;
  made.engine = site.engine().name;
  made.engine_reason = site.engine().reason;
  if (map.columns() != nullptr) {  // of a mesh the values themselves show the free cells
    if (Result<picture::Plan> plan = plan_backdrop(map)) made.plan = *std::move(plan);
  }
  made.model = model;
  made.truth = seen.truth;
  return made;
}

Result<HeatMapOfMap> from_server(const HeatMapInputs& inputs,
                                 const std::string& model,
                                 const client::HeatMapQuestion& question) {
  const ModelOptions options = options_of(inputs, model);
  SEMVIEW_TRY(const client::ConnectionConfig config,
              connection_to(inputs.server, "heatmap", kPatience));
  SEMVIEW_TRY(client::Connection connection, client::Connection::open(config));
  SEMVIEW_TRY(const protocol::MapDescription map, client::get_map(connection, inputs.site.map));
  SEMVIEW_TRY(const Seen seen, seen_by(inputs, options, map.profile.camera));
  std::unique_ptr<client::RemoteScoreSource> source;
  if (scores_depth(options)) {
    SEMVIEW_TRY(source,
                client::RemoteScoreSource::open(config, inputs.site.map, depth_scoring(options)));
  } else {
    SEMVIEW_TRY(similarity::WeightMatrix weights,
                read_weights(inputs.weights, seen.observation.classes, map.classes));
    SEMVIEW_TRY(source,
                client::RemoteScoreSource::open(config, inputs.site.map, std::move(weights)));
  }
  SEMVIEW_TRY_STATUS(source->set_observation(seen.observation));
  HeatMapOfMap made;
  SEMVIEW_TRY(made.answer, source->heat_map(question));
  made.cells = map.free_cells.size();
  made.id = map.summary.id;
  made.name = map.summary.name;
  made.fingerprint = map.summary.fingerprint;
  made.engine = map.engine;
  made.engine_reason = map.engine_reason;
  made.model = model;
  made.truth = seen.truth;
  return made;
}

}  // namespace

Result<std::vector<HeatMapOfMap>> heat_maps_of(const HeatMapInputs& inputs,
                                               const client::HeatMapQuestion& question) {
  std::shared_ptr<service::Site> site;
  if (inputs.server.empty()) {
    SEMVIEW_TRY(site, open_site(inputs.site));
  }
  std::vector<HeatMapOfMap> made;
  for (const std::string& model : inputs.models) {
    SEMVIEW_TRY(
        HeatMapOfMap one,
        site ? from_site(inputs, model, *site, question) : from_server(inputs, model, question));
    made.push_back(std::move(one));
  }
  return made;
}

}  // namespace semview::cli
