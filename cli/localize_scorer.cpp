// SPDX-License-Identifier: Apache-2.0
#include "localize_scorer.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <utility>

#include "client/lib/remote_maps.hpp"
#include "client/lib/remote_score_source.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/service/site.hpp"
#include "semview/similarity/similarity_score_source.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace semview::cli {
namespace {

struct ChosenWeights {
  similarity::WeightMatrix matrix;
  std::string name;
};

Result<ChosenWeights> choose_weights(const LocalizeOptions& options,
                                     const std::optional<std::filesystem::path>& map_folder,
                                     const ClassTable& observed,
                                     const ClassTable& map) {
  if (!options.weights.empty()) {
    SEMVIEW_TRY(similarity::WeightMatrix matrix, similarity::read_weight_matrix(options.weights));
    Status fits = matrix.check(observed, map);
    if (!fits) return with_context(std::move(fits), options.weights);
    return ChosenWeights{std::move(matrix), options.weights};
  }
  std::optional<Error> shipped_error;
  if (map_folder && std::filesystem::exists(*map_folder / "weights.csv")) {
    const std::string path = (*map_folder / "weights.csv").string();
    SEMVIEW_TRY(similarity::WeightMatrix matrix, similarity::read_weight_matrix(path));
    Status fits = matrix.check(observed, map);
    if (fits) return ChosenWeights{std::move(matrix), path};
    shipped_error = with_context(std::move(fits), path).value();
  }
  similarity::WeightMatrix identity = similarity::WeightMatrix::identity(map);
  if (identity.check(observed, map)) return ChosenWeights{std::move(identity), "identity"};
  if (shipped_error) return fail(*std::move(shipped_error));
  return fail(Error{ErrorCode::kInvalidArgument,
                    "--weights: the log's classes are not the map's, so a weight matrix is needed",
                    "--weights",
                    "make one with `semview weights init`"});
}

Result<Scorer> open_in_process(const LocalizeOptions& options, const ClassTable& observed) {
  SiteOptions site_options = options.site;
  site_options.map = options.map;
  Scorer scorer;
  SEMVIEW_TRY(scorer.site, open_site(site_options));
  const map::SemanticMap& map = scorer.site->map();
  SEMVIEW_TRY(ChosenWeights weights, choose_weights(options, map.directory, observed, map.classes));
  scorer.weights = std::move(weights.name);
  scorer.source = std::make_unique<similarity::SimilarityScoreSource>(
      scorer.site->views(), map.classes, std::move(weights.matrix), scorer.site->pool());
  if (options.global) scorer.free_cells = scorer.site->cells().free_cells();
  return scorer;
}

Result<Scorer> open_remote(const LocalizeOptions& options, const ClassTable& observed) {
  client::ConnectionConfig config;
  config.endpoint = options.server;
  config.timeout = std::chrono::milliseconds(static_cast<int>(1000.0 * options.timeout_s));
  config.client_name = "semview localize";
  if (const Status valid = validate(config); !valid) {
    Error error = valid.error();
    error.field = "--server";
    return fail(std::move(error));
  }
  SEMVIEW_TRY(client::Connection connection, client::Connection::open(config));
  SEMVIEW_TRY(protocol::MapDescription map, client::get_map(connection, options.map));
  SEMVIEW_TRY(ChosenWeights weights, choose_weights(options, std::nullopt, observed, map.classes));
  Scorer scorer;
  scorer.weights = std::move(weights.name);
  scorer.free_cells = std::move(map.free_cells);
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
