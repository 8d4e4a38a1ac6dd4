// SPDX-License-Identifier: Apache-2.0
#include "client/robot/localizer.hpp"

#include <algorithm>
#include <utility>

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

bool shows_anything(const LabelImage& labels) {
  const auto pixels = labels.pixels();
  return std::any_of(
      pixels.begin(), pixels.end(), [](const ClassId label) { return label != kUnknown; });
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
      filter_(config.filter, std::move(motion), std::move(start), seed),
      seed_(seed) {}

Result<FrameReport> Localizer::advance(const Frame& frame) {
  follow_odometry(frame.odom_from_robot);

  FrameReport report;
  if (frame.observation && shows_anything(frame.observation->labels)) {
    SEMVIEW_TRY(report, score(*frame.observation));
  } else {
    report = not_scored(FrameState::kUnseen,
                        frame.observation ? "every pixel is unknown" : "no observation");
  }
  report.stamp_s = frame.stamp_s;
  if (report.state == FrameState::kScored) {
    // From the weighted particles: resampling would only add noise to it.
    report.estimate =
        localization::estimate_pose(filter_.particles(), config_.estimate, config_.mode);
    report.resampled = filter_.resample_if_needed();
  } else {
    report.estimate = dead_reckoning();
    report.effective_sample_size = localization::effective_sample_size(filter_.particles());
  }
  map_from_last_estimate_ = report.estimate.map_from_robot;
  return report;
}

void Localizer::follow_odometry(const Pose2& odom_from_robot) {
  if (odom_from_last_frame_) {
    const Pose2 before_from_after = inverse(*odom_from_last_frame_) * odom_from_robot;
    filter_.predict(before_from_after);
    if (map_from_last_estimate_) {
      map_from_last_estimate_ = *map_from_last_estimate_ * before_from_after;
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
  filter_.restart(posterior.draw(filter_.particles().size(), rng));
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

}  // namespace semview::robot
