// SPDX-License-Identifier: Apache-2.0
/// A heading from what the camera sees and what odometry says.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "semview/core/result.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/observation/similarity_weighting.hpp"
#include "semview/view/score_source.hpp"

namespace semview::observation {

struct CombinedHeadingConfig {
  /// σ of the heading that a particle carries, in (0, π]: drift of one step and the grid's 3°.
  double sigma_rad = kPi / 30.0;
  /// Probability that the carried heading means nothing, in (0, 1]: so a lost heading comes back.
  double lost_probability = 0.001;
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const CombinedHeadingConfig& config);

struct HeadingChoice {
  double heading_rad = 0.0;  ///< between headings of the grid, by a parabola; NaN: none possible
  double log_weight = 0.0;   ///< of the place with that heading
};

/// The heading of highest weight(similarity) · prior, and that product.
///
/// prior(δ) = (1 - lost) · exp(-δ² / 2σ²) + lost, δ from `carried_yaw_rad`; 1 everywhere if that is
/// not known. Ties: the heading nearest to the carried one.
/// @param curve  the sums of one cell, in order of the headings of the PoseGrid
HeadingChoice combine_heading(std::span<const std::int32_t> curve,
                              const ScoreBatch& batch,
                              std::optional<double> carried_yaw_rad,
                              const SimilarityWeightingConfig& weighting,
                              const CombinedHeadingConfig& config);

}  // namespace semview::observation
