// SPDX-License-Identifier: Apache-2.0
/// Monte Carlo localization of one robot, frame by frame, with whatever scores its poses.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/localization/heading_strategy.hpp"
#include "semview/localization/motion_model.hpp"
#include "semview/localization/particle_filter.hpp"
#include "semview/localization/pose_estimate.hpp"
#include "semview/localization/recovery.hpp"
#include "semview/observation/combined_heading.hpp"
#include "semview/observation/dense_posterior.hpp"
#include "semview/observation/lost_probability.hpp"
#include "semview/observation/score_source_observation_model.hpp"
#include "semview/observation/similarity_weighting.hpp"
#include "semview/view/score_source.hpp"

namespace semview::robot {

/// Where recovery takes fresh particles from.
enum class Newcomers {
  kUniform,  ///< anywhere in the free space
  kDense,    ///< from what the current observation says of every free cell and heading
};

/// docs/localization.md tells what each parameter does and why it has its default.
struct LocalizerConfig {
  localization::HeadingStrategy heading = localization::HeadingStrategy::kOdometry;
  localization::ParticleFilterConfig filter = {};
  observation::SimilarityWeightingConfig weighting = {};
  observation::CombinedHeadingConfig combined = {};  ///< of HeadingStrategy::kCombined
  /// Set: particles are given up for others when observations fit worse than they used to.
  std::optional<localization::RecoveryConfig> recovery = {};
  Newcomers newcomers = Newcomers::kUniform;
  /// Whether frames get a probability of being lost. It was learned on views' similarities.
  bool judges_lost = true;
  bool refine = false;  ///< the estimate is moved to the top of the observation's similarity
  localization::EstimateKind estimate = localization::EstimateKind::kStrongestMode;
  localization::ModeConfig mode = {};
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const LocalizerConfig& config);

/// One moment of the robot's drive.
struct Frame {
  double stamp_s = 0.0;
  Pose2 odom_from_robot;                   ///< odometry at this stamp
  std::optional<Observation> observation;  ///< none: the camera gave nothing
};

enum class FrameState {
  kScored,         ///< the observation has been used
  kStale,          ///< nobody could score it: the pose is dead reckoning from the last good one
  kUnseen,         ///< there was nothing to score: dead reckoning as well
  kUninformative,  ///< it was scored, but no particle was possible: dead reckoning as well
};

/// "scored", "stale", "unseen" or "uninformative".
std::string_view name(FrameState state);

/// What became of a frame.
struct FrameReport {
  double stamp_s = 0.0;
  FrameState state = FrameState::kScored;
  std::string reason;  ///< why it was not scored; empty if it was
  localization::PoseEstimate estimate;
  double effective_sample_size = 0.0;
  bool resampled = false;
  observation::ScoreSummary scores;  ///< zeros unless scored
  std::size_t particles = 0;         ///< that were weighed
  std::size_t replaced = 0;          ///< by recovery
  /// How the map is distorted, if that is estimated.
  std::optional<localization::AffineEstimate> affine = {};
  /// That the pose is wrong: of this frame, or of the last one that could be judged. None before
  /// that, and if the free cells are not known.
  std::optional<double> lost_probability = {};
  std::optional<observation::LostFeatures> lost_features = {};  ///< of this frame
};

/// What a search of all cells found.
struct DenseStart {
  double stamp_s = 0.0;   ///< of the frame that was searched for
  std::size_t cells = 0;  ///< each with all headings
  std::vector<observation::PosteriorMode> modes;
};

/// The filter of one robot.
///
/// When the source cannot be reached, is too slow or too busy (kUnavailable, kDeadlineExceeded,
/// kResourceExhausted, kCancelled) the robot goes on by odometry: particles spread as their motion
/// model says, and the reported pose moves on from the last scored one. The next frame tries again.
/// @threads for one thread at a time
class Localizer {
 public:
  /// `source` must outlive the localizer; `config` must be valid; `start` not empty: the belief at
  /// the first frame.
  Localizer(const LocalizerConfig& config,
            ScoreSource& source,
            std::shared_ptr<const localization::MotionModel> motion,
            localization::ParticleSet start,
            std::uint64_t seed);

  /// Lets the first observation that can be scored be compared with all headings of `cells` (not
  /// empty) and the particles be drawn anew from what it says, whatever they are until then. As
  /// many are drawn as there are.
  /// @param progress  As of `observation::DensePosterior::compute`.
  void search(std::vector<CellIndex> cells, observation::SearchProgress progress = {}) {
    cells_to_search_ = std::move(cells);
    search_progress_ = std::move(progress);
  }

  /// The cells that a robot may be in: what the estimate is compared with to tell whether the robot
  /// is lost, and where recovery takes particles from. Without them neither happens.
  void know_free_cells(std::vector<CellIndex> cells);

  /// What the search found, once it is done.
  const std::optional<DenseStart>& dense_start() const { return dense_start_; }

  /// @errors those of the source that waiting does not heal, a wrong map or matrix for example.
  Result<FrameReport> advance(const Frame& frame);

  const localization::ParticleSet& particles() const { return filter_.particles(); }

 private:
  void follow_odometry(const Pose2& odom_from_robot);
  Result<FrameReport> score(const Observation& observation);
  Result<FrameReport> weigh(const Observation& observation);
  Result<FrameReport> search_cells(const Observation& observation);
  localization::PoseEstimate dead_reckoning() const;
  Status look_closer(const Observation& observation, FrameReport& report);
  Status judge(const Pose2& map_from_eye, const MapAffine& affine, FrameReport& report);
  Status refine(const Pose2& base_from_eye, const MapAffine& affine, FrameReport& report);
  Status resample(const Observation& observation, FrameReport& report);
  Result<localization::ParticleSet> newcomers(const Observation& observation, std::size_t count);
  MapAffine map_affine() const;

  LocalizerConfig config_;
  ScoreSource& source_;
  observation::ScoreSourceObservationModel model_;
  localization::ParticleFilter filter_;
  std::uint64_t seed_;
  std::vector<CellIndex> cells_to_search_;  ///< empty: no search, or done
  observation::SearchProgress search_progress_;
  std::optional<DenseStart> dense_start_;
  std::vector<CellIndex> free_cells_;
  std::vector<CellIndex> probe_cells_;  ///< some of them
  observation::LostWatch lost_watch_;
  std::optional<double> lost_probability_;
  std::optional<localization::RecoveryMonitor> recovery_;
  double mean_likelihood_ = 0.0;  ///< of the last update
  std::uint64_t frames_ = 0;
  std::optional<Pose2> odom_from_last_frame_;
  std::optional<Pose2> map_from_last_estimate_;  ///< carried on by odometry
};

}  // namespace semview::robot
