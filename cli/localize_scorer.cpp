// SPDX-License-Identifier: Apache-2.0
#include "localize_scorer.hpp"

#include <chrono>
#include <utility>

#include <fmt/format.h>

#include "client/lib/remote_maps.hpp"
#include "client/lib/remote_score_source.hpp"
#include "semview/core/log.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/service/shipped_weights.hpp"
#include "semview/service/site.hpp"
#include "semview/similarity/similarity_score_source.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "server_option.hpp"
#include "weights_option.hpp"

namespace semview::cli {
namespace {

struct ChosenWeights {
  similarity::WeightMatrix matrix;
  std::string name;
};

/// `shipped_csv` is the map's own matrix, empty if it has none.
Result<ChosenWeights> choose_weights(const LocalizeOptions& options,
                                     const std::string& shipped_csv,
                                     const ClassTable& observed,
                                     const ClassTable& map) {
  if (!options.weights.empty()) {
    SEMVIEW_TRY(similarity::WeightMatrix matrix, read_weights(options.weights, observed, map));
    Status fits = matrix.check(observed, map);
    if (!fits) return with_context(std::move(fits), options.weights);
    return ChosenWeights{std::move(matrix), options.weights};
  }
  const std::string shipped_name = options.map + ": weights.csv";
  std::string why_not = "the map has no weights.csv";
  if (!shipped_csv.empty()) {
    SEMVIEW_TRY(similarity::WeightMatrix matrix,
                similarity::parse_weight_matrix(shipped_csv, shipped_name));
    const Status fits = matrix.check(observed, map);
    if (fits) return ChosenWeights{std::move(matrix), shipped_name};
    why_not = fmt::format("{}: {}", shipped_name, fits.error().message);
  }
  similarity::WeightMatrix identity = similarity::WeightMatrix::identity(map);
  const Status same = identity.check(observed, map);
  if (same) {
    log_warning(fmt::format("weights: identity (only equal names score), for {}", why_not));
    return ChosenWeights{std::move(identity), std::string(kIdentityWeights)};
  }
  return fail(Error{
      ErrorCode::kInvalidArgument,
      fmt::format("--weights is needed: {}, and not every class of the log is the map's", why_not),
      "--weights",
      same.error().hint});
}

Result<Scorer> open_in_process(const LocalizeOptions& options, const ClassTable& observed) {
  SiteOptions site_options = options.site;
  site_options.map = options.map;
  Scorer scorer;
  SEMVIEW_TRY(scorer.site, open_site(site_options));
  const map::SemanticMap& map = scorer.site->map();
  SEMVIEW_TRY(const std::string shipped, service::shipped_weights_csv(map.directory));
  SEMVIEW_TRY(ChosenWeights weights, choose_weights(options, shipped, observed, map.classes));
  scorer.weights = std::move(weights.name);
  scorer.source = std::make_unique<similarity::SimilarityScoreSource>(
      scorer.site->views(), map.classes, std::move(weights.matrix), scorer.site->pool());
  scorer.free_cells = scorer.site->cells().free_cells();
  scorer.engine = scorer.site->engine().name;
  scorer.engine_reason = scorer.site->engine().reason;
  return scorer;
}

Result<Scorer> open_remote(const LocalizeOptions& options, const ClassTable& observed) {
  const std::chrono::milliseconds timeout(static_cast<int>(1000.0 * options.timeout_s));
  SEMVIEW_TRY(const client::ConnectionConfig config,
              connection_to(options.server, "localize", timeout));
  SEMVIEW_TRY(client::Connection connection, client::Connection::open(config));
  SEMVIEW_TRY(protocol::MapDescription map, client::get_map(connection, options.map));
  SEMVIEW_TRY(ChosenWeights weights,
              choose_weights(options, map.weights_csv, observed, map.classes));
  Scorer scorer;
  scorer.weights = std::move(weights.name);
  scorer.free_cells = std::move(map.free_cells);
  scorer.engine = std::move(map.engine);
  scorer.engine_reason = std::move(map.engine_reason);
  SEMVIEW_TRY(scorer.source,
              client::RemoteScoreSource::open(config, options.map, std::move(weights.matrix)));
  return scorer;
}

}  // namespace

Result<Scorer> open_scorer(const LocalizeOptions& options, const ClassTable& observed) {
  return options.server.empty() ? open_in_process(options, observed)
                                : open_remote(options, observed);
}

}  // namespace semview::cli
