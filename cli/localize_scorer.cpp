// SPDX-License-Identifier: Apache-2.0
#include "localize_scorer.hpp"

#include <chrono>
#include <utility>

#include "client/lib/remote_maps.hpp"
#include "client/lib/remote_score_source.hpp"
#include "map_weights.hpp"
#include "semview/field/field_score_source.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/observation/mixed_score_source.hpp"
#include "semview/service/field_likelihoods.hpp"
#include "semview/service/shipped_weights.hpp"
#include "semview/service/site.hpp"
#include "semview/similarity/similarity_score_source.hpp"
#include "server_option.hpp"

namespace semview::cli {
namespace {

using Source = std::unique_ptr<ScoreSource>;

/// One source of the one or two that there are.
Source joined(Source views, Source depth, const LocalizeOptions& options) {
  if (views == nullptr) return depth;
  if (depth == nullptr) return views;
  return std::make_unique<observation::MixedScoreSource>(
      std::move(views), std::move(depth), mixed_config(options));
}

Result<Source> views_of_site(const LocalizeOptions& options,
                             const ClassTable& observed,
                             Scorer& scorer) {
  const map::SemanticMap& map = scorer.site->map();
  SEMVIEW_TRY(const std::string shipped, service::shipped_weights_csv(map.directory));
  SEMVIEW_TRY(ChosenWeights weights,
              choose_weights(options.weights, options.map, shipped, observed, map.classes));
  scorer.weights = std::move(weights.name);
  scorer.engine = scorer.site->engine().name;
  scorer.engine_reason = scorer.site->engine().reason;
  return std::make_unique<similarity::SimilarityScoreSource>(
      scorer.site->views(), map.classes, std::move(weights.matrix), scorer.site->pool());
}

Result<Source> depth_of_site(const LocalizeOptions& options, const Scorer& scorer) {
  SEMVIEW_TRY(const auto likelihood, scorer.site->likelihoods().of(depth_scoring(options.model)));
  return std::make_unique<field::FieldScoreSource>(
      likelihood, scorer.site->profile(), scorer.site->pool());
}

Result<Scorer> open_in_process(const LocalizeOptions& options, const ClassTable& observed) {
  SiteOptions site_options = options.site;
  site_options.map = options.map;
  Scorer scorer;
  SEMVIEW_TRY(scorer.site, open_site(site_options));
  scorer.free_cells = scorer.site->cells().free_cells();
  scorer.engine = "distances";
  scorer.engine_reason = scorer.site->map().volume.empty() ? "of the plan" : "of the fused volume";
  scorer.weights = "none";
  Source views;
  Source depth;
  if (scores_views(options.model)) {
    SEMVIEW_TRY(views, views_of_site(options, observed, scorer));
  }
  if (scores_depth(options.model)) {
    SEMVIEW_TRY(depth, depth_of_site(options, scorer));
  }
  scorer.source = joined(std::move(views), std::move(depth), options);
  return scorer;
}

Result<Scorer> open_remote(const LocalizeOptions& options, const ClassTable& observed) {
  const std::chrono::milliseconds timeout(static_cast<int>(1000.0 * options.timeout_s));
  SEMVIEW_TRY(const client::ConnectionConfig config,
              connection_to(options.server, "localize", timeout));
  SEMVIEW_TRY(client::Connection connection, client::Connection::open(config));
  SEMVIEW_TRY(protocol::MapDescription map, client::get_map(connection, options.map));
  Scorer scorer;
  scorer.free_cells = std::move(map.free_cells);
  scorer.engine = "distances";
  scorer.engine_reason = "of the server's map";
  scorer.weights = "none";
  Source views;
  Source depth;
  if (scores_views(options.model)) {
    SEMVIEW_TRY(
        ChosenWeights weights,
        choose_weights(options.weights, options.map, map.weights_csv, observed, map.classes));
    scorer.weights = std::move(weights.name);
    scorer.engine = std::move(map.engine);
    scorer.engine_reason = std::move(map.engine_reason);
    SEMVIEW_TRY(views,
                client::RemoteScoreSource::open(config, options.map, std::move(weights.matrix)));
  }
  if (scores_depth(options.model)) {
    SEMVIEW_TRY(depth,
                client::RemoteScoreSource::open(config, options.map, depth_scoring(options.model)));
  }
  scorer.source = joined(std::move(views), std::move(depth), options);
  return scorer;
}

}  // namespace

Result<Scorer> open_scorer(const LocalizeOptions& options, const ClassTable& observed) {
  return options.server.empty() ? open_in_process(options, observed)
                                : open_remote(options, observed);
}

}  // namespace semview::cli
