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
#include "semview/service/field_likelihoods.hpp"
#include "semview/service/shipped_weights.hpp"
#include "semview/service/site.hpp"
#include "semview/similarity/similarity_score_source.hpp"
#include "server_option.hpp"

namespace semview::cli {
namespace {

Result<Scorer> open_in_process(const LocalizeOptions& options, const ClassTable& observed) {
  SiteOptions site_options = options.site;
  site_options.map = options.map;
  Scorer scorer;
  SEMVIEW_TRY(scorer.site, open_site(site_options));
  const map::SemanticMap& map = scorer.site->map();
  SEMVIEW_TRY(const std::string shipped, service::shipped_weights_csv(map.directory));
  SEMVIEW_TRY(ChosenWeights weights,
              choose_weights(options.weights, options.map, shipped, observed, map.classes));
  scorer.weights = std::move(weights.name);
  scorer.source = std::make_unique<similarity::SimilarityScoreSource>(
      scorer.site->views(), map.classes, std::move(weights.matrix), scorer.site->pool());
  scorer.free_cells = scorer.site->cells().free_cells();
  scorer.engine = scorer.site->engine().name;
  scorer.engine_reason = scorer.site->engine().reason;
  return scorer;
}

Result<Scorer> open_field(const LocalizeOptions& options) {
  SiteOptions site_options = options.site;
  site_options.map = options.map;
  Scorer scorer;
  SEMVIEW_TRY(scorer.site, open_site(site_options));
  SEMVIEW_TRY(const auto likelihood, scorer.site->likelihoods().of(depth_scoring(options.model)));
  scorer.source = std::make_unique<field::FieldScoreSource>(
      likelihood, scorer.site->profile(), scorer.site->pool());
  scorer.free_cells = scorer.site->cells().free_cells();
  scorer.engine = "distances";
  scorer.engine_reason = scorer.site->map().volume.empty() ? "of the plan" : "of the fused volume";
  scorer.weights = "none";
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
  if (scores_depth(options.model)) {
    SEMVIEW_TRY(scorer.source,
                client::RemoteScoreSource::open(config, options.map, depth_scoring(options.model)));
    scorer.engine = "distances";
    scorer.engine_reason = "of the server's map";
    scorer.weights = "none";
    return scorer;
  }
  SEMVIEW_TRY(ChosenWeights weights,
              choose_weights(options.weights, options.map, map.weights_csv, observed, map.classes));
  scorer.weights = std::move(weights.name);
  scorer.engine = std::move(map.engine);
  scorer.engine_reason = std::move(map.engine_reason);
  SEMVIEW_TRY(scorer.source,
              client::RemoteScoreSource::open(config, options.map, std::move(weights.matrix)));
  return scorer;
}

}  // namespace

Result<Scorer> open_scorer(const LocalizeOptions& options, const ClassTable& observed) {
  if (!options.server.empty()) return open_remote(options, observed);
  return scores_depth(options.model) ? open_field(options) : open_in_process(options, observed);
}

}  // namespace semview::cli
