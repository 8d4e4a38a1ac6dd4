// SPDX-License-Identifier: Apache-2.0
/// Where a single picture was taken.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/observation/dense_posterior.hpp"
#include "semview/places/column_scorer.hpp"
#include "semview/places/place_refinement.hpp"
#include "semview/service/site.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/observation.hpp"

namespace semview::places {

struct PlaceSearchConfig {
  /// weight = exp(κ · score), > 0: neighbouring pixels err together, so that a panorama is worth
  /// some hundred independent ones, not thousands.
  double kappa = 100.0;
  /// The same on the grid, where it only says which peaks are worth a closer look.
  double grid_kappa = 20.0;
  std::size_t candidates = 64;  ///< peaks of the grid that are refined, an eye height
  std::size_t most_places = 16;
  /// Refined candidates nearer than this to a better one, in both, are the same place.
  double same_place_m = 0.4;
  double same_place_rad = kPi / 9.0;
  ColumnScorerConfig columns = {};
  RefinementConfig refinement = {};
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const PlaceSearchConfig& config);

struct Place {
  Pose2 map_from_robot;
  double eye_height_m = 0.0;
  double score = 0.0;        ///< mean log-likelihood ratio a pixel, each column limited
  double probability = 0.0;  ///< among all places found, if the picture is of this map
};

struct PlaceSearch {
  std::vector<Place> places;  ///< strongest first; empty: no view anywhere
  /// Of all places found, also those past `most_places`: 0 bits is certainty, 1 bit two places that
  /// are equally likely.
  double entropy_bits = 0.0;
  std::size_t cells = 0;       ///< compared, over all eye heights
  std::size_t best_floor = 0;  ///< which of the sites the strongest place was found with
  /// Over the cells of that site, before refinement.
  std::optional<observation::DensePosterior> posterior;
};

/// (done, all, of what: "cells", and then "places" between them); by one thread at a time.
using PlaceProgress = std::function<void(std::size_t, std::size_t, std::string_view)>;

/// Compares an observation with the views of all free cells of one map at some eye heights, in all
/// headings; then searches on from each of the strongest peaks off the grid, with exact views that
/// are scored column by column (`ColumnScorer`).
///
/// @param floors  the same map at one or more eye heights, at least one, with one profile camera in
///                which `observation` is; with several the eye height is searched as well.
/// @param weights  logarithms of likelihood ratios (`similarity::plan_likelihood_weights`, learned)
/// @param progress  may be empty
/// @errors those of `validate`, `ScoreSource::set_observation` and `DensePosterior::compute`.
Result<PlaceSearch> find_places(std::span<const std::shared_ptr<service::Site>> floors,
                                const Observation& observation,
                                const similarity::WeightMatrix& weights,
                                const PlaceSearchConfig& config,
                                const PlaceProgress& progress = {});

}  // namespace semview::places
