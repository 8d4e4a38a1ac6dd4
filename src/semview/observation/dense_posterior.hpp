// SPDX-License-Identifier: Apache-2.0
/// What one observation says of every place at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "semview/core/random.hpp"
#include "semview/core/result.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/localization/particle_set.hpp"
#include "semview/localization/pose_estimate.hpp"
#include "semview/observation/score_source_observation_model.hpp"
#include "semview/observation/similarity_weighting.hpp"
#include "semview/view/score_source.hpp"

namespace semview::observation {

/// Above this a posterior is refused: its sums take 480 bytes a cell.
inline constexpr std::size_t kMaxPosteriorCells = 1'000'000;

/// (cells done, cells); false: stop.
using SearchProgress = std::function<bool(std::size_t, std::size_t)>;

/// One of the places that an observation may have been made at.
struct PosteriorMode {
  Pose2 map_from_robot;      ///< with the eye at the centre of the highest cell and heading
  double similarity = 0.0;   ///< there
  double probability = 0.0;  ///< that the robot is near it, as near as particles of one mode are
};

/// The probability of every heading of the PoseGrid in every one of some cells, before anything
/// else is known: with the weights that the particle filter gives, over all hypotheses instead of
/// some. A hypothesis says where the eye is.
///
/// The source is asked for the whole curve of headings of each cell, some hundred cells a call. So
/// 480 bytes a cell travel from a server: sums, as in every other answer, because it is the robot
/// that turns them into weights. There is no cheaper way to be exact: with weights that fall as
/// slowly as those of one observation do, no cell can be left out that might not matter together
/// with the others. A floor of 10 000 cells takes 5 MB once.
class DensePosterior {
 public:
  /// Of the observation that `source` was given.
  /// @param cells  Where the eye may be; may repeat.
  /// @param progress  Called after each answer with (cells done, cells); may be empty. Returning
  ///        false ends the work with kCancelled.
  /// @param affine  How the map is taken to be distorted.
  /// @errors kCancelled; kInvalidArgument: no cells; kResourceExhausted: above
  /// `kMaxPosteriorCells`; those of `ScoreSource::score`; kInternal: an answer of another size than
  /// the question.
  static Result<DensePosterior> compute(ScoreSource& source,
                                        const SimilarityWeightingConfig& config,
                                        std::vector<CellIndex> cells,
                                        const Pose2& base_from_eye,
                                        const SearchProgress& progress = {},
                                        const MapAffine& affine = {});

  /// False if no hypothesis is possible: then there are neither probabilities nor particles.
  bool informative() const { return total_ > 0.0; }
  std::span<const CellIndex> cells() const { return cells_; }  ///< distinct, sorted
  /// Of a heading in `cells()[cell]`. A cell without a view has none.
  double probability(std::size_t cell, int heading) const;
  /// Over the cells, each at its best heading.
  const ScoreSummary& scores() const { return scores_; }

  /// The strongest modes, highest peak first: peaks higher than all their neighbours on the grid,
  /// not as near to a higher one as `config` says; those below a thousandth of the highest are
  /// left out. What lies near two modes counts for the higher one.
  std::vector<PosteriorMode> modes(std::size_t most,
                                   const localization::ModeConfig& config = {}) const;

  /// `count` > 0 particles of equal weight, drawn systematically over the cells: the eye anywhere
  /// in its cell, the heading anywhere within ±1.5° of the grid's. Needs `informative()`.
  localization::ParticleSet draw(std::size_t count, Rng& rng) const;

 private:
  DensePosterior() = default;
  Status take(const ScoreBatch& batch, std::size_t cells);
  void weigh();
  std::span<const std::int32_t> curve(std::size_t cell) const;
  double weight(std::int32_t sum) const;
  bool is_peak(std::size_t cell, int heading) const;
  template <typename Visit>
  void around(const GridKey& center, int cells, int headings, const Visit& visit) const;

  SimilarityWeightingConfig config_;
  Pose2 eye_from_base_;
  std::vector<CellIndex> cells_;
  std::vector<std::int32_t> sums_;    ///< 120 a cell
  std::vector<double> cell_weights_;  ///< of all headings, relative to the highest of them
  double highest_log_weight_ = 0.0;
  double total_ = 0.0;
  std::int32_t weight_scale_ = 0;
  std::int32_t observed_pixels_ = 0;
  ScoreSummary scores_;
};

}  // namespace semview::observation
