// SPDX-License-Identifier: Apache-2.0
#include "semview/places/place_search.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/similarity/similarity_score_source.hpp"

namespace semview::places {
namespace {

using observation::DensePosterior;

constexpr std::size_t kMostCandidates = 10'000;

struct Candidate {
  std::size_t floor = 0;
  EyePlacement at;
};

Result<DensePosterior> posterior_of(const service::Site& floor,
                                    const Observation& observation,
                                    const similarity::WeightMatrix& weights,
                                    double kappa,
                                    const observation::SearchProgress& progress) {
  similarity::SimilarityScoreSource source(
      floor.views(), floor.map().classes, weights, floor.pool());
  SEMVIEW_TRY_STATUS(source.set_observation(observation));
  observation::SimilarityWeightingConfig weighting;
  weighting.transform = observation::WeightTransform::kExponential;
  weighting.kappa = kappa;
  // In terms of the eye: what stands on the robot is turned back at the end.
  return DensePosterior::compute(source, weighting, floor.cells().free_cells(), {}, progress);
}

ExactView views_of(const service::Site& floor) {
  return [&floor](double x_m, double y_m, double eye_height_m) -> std::optional<LabelImage> {
    const auto cell = PoseGrid::cell(x_m, y_m);
    if (!cell || !floor.cells().has_eye(*cell)) return {};
    raycast::PanoramaRequest request;
    request.map_from_robot = {x_m, y_m, 0.0};
    request.eye_z_m = floor.eye_z_m(eye_height_m);
    request.camera = floor.profile().camera;
    Result<raycast::Panorama> panorama = floor.exact_panorama(request);
    if (!panorama) return {};
    return std::move(panorama->labels);
  };
}

/// Refined candidates, best first, each place once.
std::vector<EyePlacement> distinct(std::vector<Candidate>& candidates,
                                   const PlaceSearchConfig& config) {
  std::ranges::stable_sort(candidates,
                           [](const auto& a, const auto& b) { return a.at.score > b.at.score; });
  std::vector<EyePlacement> places;
  for (const Candidate& candidate : candidates) {
    if (!std::isfinite(candidate.at.score)) continue;
    const bool known = std::ranges::any_of(places, [&](const EyePlacement& place) {
      const double turn_rad =
          wrap_angle(place.map_from_eye.yaw_rad - candidate.at.map_from_eye.yaw_rad);
      return distance_m(place.map_from_eye, candidate.at.map_from_eye) < config.same_place_m &&
             std::abs(turn_rad) < config.same_place_rad;
    });
    if (!known) places.push_back(candidate.at);
  }
  return places;
}

void add_places(PlaceSearch& search,
                const std::vector<EyePlacement>& found,
                const Pose2& base_from_eye,
                const PlaceSearchConfig& config) {
  double total = 0.0;
  for (const EyePlacement& place : found) {
    total += std::exp(config.kappa * (place.score - found.front().score));
  }
  for (const EyePlacement& place : found) {
    const double probability = std::exp(config.kappa * (place.score - found.front().score)) / total;
    if (probability > 0.0) search.entropy_bits -= probability * std::log2(probability);
    if (search.places.size() == config.most_places) continue;
    search.places.push_back({place.map_from_eye * inverse(base_from_eye),
                             place.eye_height_m,
                             place.score,
                             probability});
  }
}

tl::unexpected<Error> out_of_range(const char* field, double value, const char* expected) {
  return fail(Error{
      ErrorCode::kInvalidArgument, fmt::format("{} {} is not {}", field, value, expected), field});
}

}  // namespace

Status validate(const PlaceSearchConfig& config) {
  if (!(config.kappa > 0.0 && config.kappa <= 1e4)) {
    return out_of_range("kappa", config.kappa, "in (0, 10000]");
  }
  if (!(config.grid_kappa > 0.0 && config.grid_kappa <= 1e4)) {
    return out_of_range("grid_kappa", config.grid_kappa, "in (0, 10000]");
  }
  if (config.candidates < 1 || config.candidates > kMostCandidates) {
    return out_of_range("candidates", static_cast<double>(config.candidates), "in 1..10000");
  }
  if (config.most_places < 1 || config.most_places > kMostCandidates) {
    return out_of_range("most_places", static_cast<double>(config.most_places), "in 1..10000");
  }
  return validate(config.columns);
}

Result<PlaceSearch> find_places(std::span<const std::shared_ptr<service::Site>> floors,
                                const Observation& observation,
                                const similarity::WeightMatrix& weights,
                                const PlaceSearchConfig& config,
                                const PlaceProgress& progress) {
  SEMVIEW_CHECK(!floors.empty());
  SEMVIEW_TRY_STATUS(validate(config));
  PlaceSearch search;
  std::vector<Candidate> candidates;
  std::vector<DensePosterior> posteriors;
  for (std::size_t f = 0; f < floors.size(); ++f) {
    SEMVIEW_TRY(DensePosterior posterior,
                posterior_of(*floors[f],
                             observation,
                             weights,
                             config.grid_kappa,
                             [&](std::size_t done, std::size_t cells) {
                               if (progress) {
                                 progress(f * cells + done, floors.size() * cells, "cells");
                               }
                               return true;
                             }));
    search.cells += posterior.cells().size();
    for (const observation::PosteriorMode& mode : posterior.modes(config.candidates)) {
      candidates.push_back(
          {f, {mode.map_from_robot, floors[f]->profile().eye_height_m, mode.similarity}});
    }
    posteriors.push_back(std::move(posterior));
  }
  SEMVIEW_TRY(const ColumnScorer scorer,
              ColumnScorer::build(observation,
                                  weights,
                                  floors[0]->map().classes,
                                  floors[0]->profile().camera,
                                  config.columns));
  RefinementConfig refinement = config.refinement;
  refinement.finds_eye_height = refinement.finds_eye_height || floors.size() > 1;
  std::mutex mutex;
  std::size_t refined = 0;
  floors[0]->pool().parallel_for(candidates.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      candidates[i].at =
          refine(candidates[i].at, scorer, views_of(*floors[candidates[i].floor]), refinement);
      const std::lock_guard lock(mutex);
      if (progress) progress(++refined, candidates.size(), "places");
    }
  });
  const std::vector<EyePlacement> found = distinct(candidates, config);
  if (!candidates.empty()) search.best_floor = candidates.front().floor;
  search.posterior = std::move(posteriors[search.best_floor]);
  if (!found.empty()) add_places(search, found, observation.base_from_eye, config);
  return search;
}

}  // namespace semview::places
