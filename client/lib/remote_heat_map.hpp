// SPDX-License-Identifier: Apache-2.0
/// What is asked of a server's heat map, and what it answers.
#pragma once

#include <optional>

#include "client/lib/remote_maps.hpp"
#include "semview/core/result.hpp"
#include "semview/observation/similarity_weighting.hpp"
#include "semview/similarity/heat_map.hpp"

namespace semview::v1 {
class HeatmapReply;
class HeatmapRequest;
}  // namespace semview::v1

namespace semview::client {

struct HeatMapQuestion {
  std::optional<Region> region = {};  ///< none: all free cells of the map
  int headings = PoseGrid::kHeadings;
  /// Also asks for the probability of each cell, with these weights.
  std::optional<observation::SimilarityWeightingConfig> posterior = {};
};

struct HeatMapAnswer {
  similarity::HeatMap heat;  ///< without `log_weight`
  Image<float> probability;  ///< of the same cells, 1 over all of them; empty unless asked for
};

/// The question's part of the message: all but map, fingerprint and observation.
void to_wire(const HeatMapQuestion& question, v1::HeatmapRequest* wire);
/// @errors kDataLoss: not an answer to `question`.
Result<HeatMapAnswer> from_wire(const v1::HeatmapReply& wire, const HeatMapQuestion& question);

}  // namespace semview::client
