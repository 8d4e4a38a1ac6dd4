// SPDX-License-Identifier: Apache-2.0
/// How well one exact view fits an observation, column by column, with a limit on what a single
/// column may say.
#pragma once

#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/column_view.hpp"
#include "semview/view/observation.hpp"

namespace semview::places {

struct ColumnScorerConfig {
  /// Probability that a column shows something else than the plan (a cupboard that nobody drew, an
  /// open door, a blunder of the network), in (0, 1).
  double stray_probability = 0.15;
  /// How many independent pixels a column is worth, > 0: the larger, the harder the limit.
  double pixels_per_column = 8.0;
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const ColumnScorerConfig& config);

/// The mean over the observed pixels of ρ(m), m the mean weight of the pixel's column and
/// ρ(m) = ln((1 - s)·exp(n·m) + s) / n: the log-likelihood of a column that with probability s
/// means nothing. Where m is high, ρ(m) is nearly m; however low it is, ρ(m) is at least ln(s) / n.
///
/// Weights should be logarithms of likelihood ratios, so that 0 is what says nothing.
/// Immutable. @threads safe
class ColumnScorer {
 public:
  /// @param observation  in the shape of `camera`
  /// @errors kInvalidArgument: other shape or nothing observed; kFailedPrecondition: a class or an
  /// elevation that the matrix does not cover.
  static Result<ColumnScorer> build(const Observation& observation,
                                    const similarity::WeightMatrix& weights,
                                    const ClassTable& map_classes,
                                    const PanoramaCamera& camera,
                                    const ColumnScorerConfig& config);

  int columns() const { return observed_.columns(); }

  /// The score of `view`, cast at yaw 0, turned counter-clockwise by `turn` columns.
  /// @cost pixels of the observation
  double score(const LabelImage& view, int turn) const;

 private:
  ColumnScorer() = default;

  ColumnScorerConfig config_;
  LabelImage observed_;
  std::vector<double> pixels_of_column_;
  double pixels_ = 0.0;
  std::vector<std::vector<float>> band_weights_;  ///< [band][observed · 256 + map]
  std::vector<std::size_t> band_of_row_;
};

}  // namespace semview::places
