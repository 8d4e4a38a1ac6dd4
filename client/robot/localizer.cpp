// SPDX-License-Identifier: Apache-2.0
#include "client/robot/localizer.hpp"

#include <algorithm>
#include <utility>

#include "semview/localization/initialization.hpp"
#include "semview/observation/nearby_scores.hpp"

namespace semview::robot {
namespace {

using localization::PoseEstimate;
using localization::UpdateReport;
using observation::DensePosterior;

/// Places worth telling a person.
constexpr std::size_t kToldModes = 5;

/// May the same question be answered later?
bool heals_by_waiting(ErrorCode code) {
  return code == ErrorCode::kUnavailable || code == ErrorCode::kDeadlineExceeded ||
         code == ErrorCode::kResourceExhausted || code == ErrorCode::kCancelled;
}

/// Particles with an idea of how the map is distorted, if they shall have one.
localization::ParticleSet distorted(localization::ParticleSet particles,
                                    const LocalizerConfig& config,
                                    std::uint64_t seed) {
  if (config.filter.affine) {
    Rng rng(seed, "first affines");
    localization::spread_affines(particles, *config.filter.affine, rng);
  }
  return particles;
}

bool shows_anything(const Observation& observation) {
  if (observation.voxels) return true;
  const auto pixels = observation.labels.pixels();
  return std::any_of(
      pixels.begin(), pixels.end(), [](const ClassId label) { return label != kUnknown; });
}

/// A move of the estimate that follows odometry through a map drawn distorted.
Pose2 moved(const Pose2& from, const Pose2& by, const MapAffine& affine) {
  return drawn_move(from, from * by, affine);
}

/// A stale answer is no error of the frame's: what else was to be known of it stays unknown.
Status unless_healing(const Status& status) {
  return status || !heals_by_waiting(status.error().code) ? status : Status();
}

FrameReport not_scored(FrameState state, std::string reason) {
  FrameReport report;
  report.state = state;
  report.reason = std::move(reason);
  return report;
}

}  // namespace

Status validate(const LocalizerConfig& config) {
  SEMVIEW_TRY_STATUS(validate(config.filter));
  SEMVIEW_TRY_STATUS(validate(config.combined));
  if (config.recovery) SEMVIEW_TRY_STATUS(validate(*config.recovery));
  return validate(config.weighting);
}

std::string_view name(FrameState state) {
  switch (state) {
    case FrameState::kScored:
      return "scored";
    case FrameState::kStale:
      return "stale";
    case FrameState::kUnseen:
      return "unseen";
    case FrameState::kUninformative:
      return "uninformative";
  }
  return "";
}

Localizer::Localizer(const LocalizerConfig& config,
                     ScoreSource& source,
                     std::shared_ptr<const localization::MotionModel> motion,
                     localization::ParticleSet start,
                     std::uint64_t seed)
    : config_(config),
      source_(source),
      model_(source, config.heading, config.weighting, config.combined),
      filter_(config.filter, std::move(motion), distorted(std::move(start), config, seed), seed),
      seed_(seed) {
  if (config.recovery) recovery_.emplace(*config.recovery);
}

void Localizer::know_free_cells(std::vector<CellIndex> cells) {
  if (config_.judges_lost) probe_cells_ = observation::probe_cells(cells);
  free_cells_ = std::move(cells);
}

Result<FrameReport> Localizer::advance(const Frame& frame) {
  follow_odometry(frame.odom_from_robot);
  ++frames_;

  const std::size_t particles = filter_.particles().size();
  FrameReport report;
  if (frame.observation && shows_anything(*frame.observation)) {
    SEMVIEW_TRY(report, score(*frame.observation));
  } else {
    report = not_scored(FrameState::kUnseen,
                        frame.observation ? "every pixel is unknown" : "no observation");
  }
  report.stamp_s = frame.stamp_s;
  report.particles = particles;
  if (report.state == FrameState::kScored) {
    // From the weighted particles: resampling would only add noise to it.
    report.estimate =
        localization::estimate_pose(filter_.particles(), config_.estimate, config_.mode);
  } else {
    report.estimate = dead_reckoning();
    report.effective_sample_size = localization::effective_sample_size(filter_.particles());
  }
  if (config_.filter.affine) report.affine = localization::estimate_affine(filter_.particles());
  if (report.state == FrameState::kScored || report.state == FrameState::kUninformative) {
    SEMVIEW_TRY_STATUS(unless_healing(look_closer(*frame.observation, report)));
    SEMVIEW_TRY_STATUS(unless_healing(resample(*frame.observation, report)));
  }
  report.lost_probability = lost_probability_;
  map_from_last_estimate_ = report.estimate.map_from_robot;
  return report;
}

void Localizer::follow_odometry(const Pose2& odom_from_robot) {
  if (odom_from_last_frame_) {
    const Pose2 before_from_after = inverse(*odom_from_last_frame_) * odom_from_robot;
    filter_.predict(before_from_after);
    if (map_from_last_estimate_) {
      map_from_last_estimate_ = moved(*map_from_last_estimate_, before_from_after, map_affine());
    }
  }
  odom_from_last_frame_ = odom_from_robot;
}

Result<FrameReport> Localizer::score(const Observation& observation) {
  Result<FrameReport> report =
      cells_to_search_.empty() ? weigh(observation) : search_cells(observation);
  if (!report && heals_by_waiting(report.error().code)) {
    return not_scored(FrameState::kStale, std::move(report).error().message);
  }
  return report;
}

Result<FrameReport> Localizer::weigh(const Observation& observation) {
  SEMVIEW_TRY_STATUS(model_.set_observation(observation));
  SEMVIEW_TRY(const UpdateReport update, filter_.update(model_));
  FrameReport report;
  mean_likelihood_ = update.mean_likelihood;
  report.effective_sample_size = update.effective_sample_size;
  report.scores = model_.last_scores();
  if (update.outcome == localization::WeightOutcome::kUninformative) {
    report.state = FrameState::kUninformative;
    report.reason = report.scores.without_view == filter_.particles().size()
                        ? "no particle stands where the map has a view"
                        : "no particle has a similarity above 0";
  }
  return report;
}

/// The particles that this gives have the observation in them: they are not weighed by it again.
Result<FrameReport> Localizer::search_cells(const Observation& observation) {
  SEMVIEW_TRY_STATUS(source_.set_observation(observation));
  SEMVIEW_TRY(const DensePosterior posterior,
              DensePosterior::compute(source_,
                                      config_.weighting,
                                      cells_to_search_,
                                      observation.base_from_eye,
                                      search_progress_));
  FrameReport report;
  report.scores = posterior.scores();
  if (!posterior.informative()) {
    report.state = FrameState::kUninformative;
    report.reason = "no free cell has a similarity above 0";
    return report;
  }
  Rng rng(seed_, "dense start");
  filter_.restart(distorted(posterior.draw(filter_.particles().size(), rng), config_, seed_));
  report.effective_sample_size = localization::effective_sample_size(filter_.particles());
  dense_start_ = {
      observation.stamp_s, posterior.cells().size(), posterior.modes(kToldModes, config_.mode)};
  cells_to_search_.clear();
  return report;
}

PoseEstimate Localizer::dead_reckoning() const {
  PoseEstimate estimate =
      localization::estimate_pose(filter_.particles(), config_.estimate, config_.mode);
  if (map_from_last_estimate_) estimate.map_from_robot = *map_from_last_estimate_;
  return estimate;
}

/// What the particles take the map to be distorted by; the identity if that is not estimated.
MapAffine Localizer::map_affine() const {
  if (!config_.filter.affine) return {};
  return localization::estimate_affine(filter_.particles()).mean;
}

/// More about the frame that has been scored than its particles say.
Status Localizer::look_closer(const Observation& observation, FrameReport& report) {
  const MapAffine affine = report.affine ? report.affine->mean : MapAffine{};
  const Pose2& pose = report.estimate.map_from_robot;
  SEMVIEW_TRY_STATUS(judge(moved(pose, observation.base_from_eye, affine), affine, report));
  return config_.refine ? refine(observation.base_from_eye, affine, report) : Status();
}

Status Localizer::judge(const Pose2& map_from_eye, const MapAffine& affine, FrameReport& report) {
  if (probe_cells_.empty()) return {};
  SEMVIEW_TRY(const observation::PlaceScores scores,
              observation::probe_place(source_, map_from_eye, probe_cells_, affine));
  report.lost_features = lost_watch_.look(
      scores,
      report.estimate.weight,
      localization::position_ellipse(report.estimate).major_sigma_m,
      report.effective_sample_size / static_cast<double>(filter_.particles().size()));
  lost_probability_ = observation::lost_probability(*report.lost_features);
  return {};
}

Status Localizer::refine(const Pose2& base_from_eye, const MapAffine& affine, FrameReport& report) {
  Pose2& pose = report.estimate.map_from_robot;
  SEMVIEW_TRY(const observation::NearbyScores nearby,
              observation::score_nearby(source_, moved(pose, base_from_eye, affine), affine));
  const std::optional<Pose2> eye = observation::refined_pose(nearby);
  if (eye) pose = moved(*eye, inverse(base_from_eye), affine);
  return {};
}

Status Localizer::resample(const Observation& observation, FrameReport& report) {
  const auto count = static_cast<double>(filter_.particles().size());
  const double share =
      recovery_ && !free_cells_.empty() ? recovery_->share_to_replace(mean_likelihood_) : 0.0;
  const auto replaced = static_cast<std::size_t>(share * count);
  if (replaced > 0) {
    SEMVIEW_TRY(localization::ParticleSet fresh, newcomers(observation, replaced));
    report.replaced = fresh.size();
    report.resampled = !fresh.empty();
    filter_.replace_some(std::move(fresh));
  }
  if (report.replaced == 0 && report.state == FrameState::kScored) {
    report.resampled = filter_.resample_if_needed();
  }
  return {};
}

/// Particles that may be right where the others are wrong; none if nothing can be said. What is
/// known of the map's distortion holds for them, too.
Result<localization::ParticleSet> Localizer::newcomers(const Observation& observation,
                                                       std::size_t count) {
  Rng rng(seed_, "newcomers", frames_);
  localization::ParticleSet fresh;
  if (config_.newcomers == Newcomers::kUniform) {
    fresh = localization::uniform_particles(free_cells_, count, rng);
  } else {
    SEMVIEW_TRY(
        const DensePosterior posterior,
        DensePosterior::compute(
            source_, config_.weighting, free_cells_, observation.base_from_eye, {}, map_affine()));
    if (posterior.informative()) fresh = posterior.draw(count, rng);
  }
  const localization::ParticleSet& known = filter_.particles();
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    fresh[i].affine = known[i * known.size() / fresh.size()].affine;
  }
  return fresh;
}

}  // namespace semview::robot
