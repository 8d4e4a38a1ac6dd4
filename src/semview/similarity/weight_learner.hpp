// SPDX-License-Identifier: Apache-2.0
/// Weights from examples: how often a network says i where the map says j.
#pragma once

#include <cstdint>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/column_view.hpp"

namespace semview::similarity {

struct WeightLearnerConfig {
  int bands = 4;  ///< of elevation, of equal height, in 1..`kMaxElevationBands`
  /// Added to every count, > 0, in pixels: a pair that never met is unlikely, not impossible.
  double prior_pixels = 50.0;
  /// Weights are kept within ± this, > 0.
  double largest_weight = 4.0;
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const WeightLearnerConfig& config);

/// Counts pixels of observations and of the views from their true poses.
///
/// The weight of (i, j) in a band of elevation is ln P(i | j, band) - ln P(i | band): how much
/// likelier the network says i where the map has j than anywhere. Summed over pixels it is the
/// logarithm of a likelihood, up to the dependence of neighbours, which
/// `observation::SimilarityWeightingConfig::kappa` takes out. A class that was never observed says
/// nothing: its weights are 0.
///
/// @threads for one thread at a time
class WeightLearner {
 public:
  /// `config` must be valid. All images that are added have the shape of `camera`.
  WeightLearner(const WeightLearnerConfig& config,
                ClassTable observed,
                ClassTable map,
                const PanoramaCamera& camera);

  /// @param observed  labels with the heading in the middle; `kUnknown` is not counted
  /// @param seen      what the map shows at the same pixels
  void add(const LabelImage& observed, const LabelImage& seen);

  std::int64_t pixels() const { return pixels_; }

  /// @errors kFailedPrecondition: nothing was added.
  Result<WeightMatrix> matrix() const;

 private:
  double& count(int band, ClassId observed, ClassId seen);

  WeightLearnerConfig config_;
  ClassTable observed_;
  ClassTable map_;
  PanoramaCamera camera_;
  std::vector<double> counts_;  ///< band, observed class, map class with `kNoHit` first
  std::int64_t pixels_ = 0;
};

}  // namespace semview::similarity
