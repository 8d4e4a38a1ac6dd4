// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/score_source_observation_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "semview/geometry/pose_grid.hpp"
#include "semview/observation/pose_curves.hpp"

namespace semview::observation {
namespace {

using localization::ObservationWeights;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

Status check_shape(const ScoreBatch& batch, std::size_t poses, const ScoreRequest& request) {
  const bool compass = request.mode == HeadingMode::kCompass;
  const bool complete =
      batch.sums.size() == poses && (!compass || batch.best_heading.size() == poses);
  if (complete && batch.weight_scale > 0 && batch.observed_pixels > 0) return {};
  return fail(ErrorCode::kInternal,
              fmt::format("the score source answered {} sums and {} headings of {} poses "
                          "(scale {}, {} observed pixels)",
                          batch.sums.size(),
                          batch.best_heading.size(),
                          poses,
                          batch.weight_scale,
                          batch.observed_pixels));
}

ScoreSummary summarize(const ScoreBatch& batch) {
  ScoreSummary summary;
  summary.origins = batch.origins;
  // Sums are integers, so the mean does not depend on an order of summation.
  std::int64_t total = 0;
  std::int32_t best = kNoView;
  for (const std::int32_t sum : batch.sums) {
    if (sum == kNoView) {
      ++summary.without_view;
      continue;
    }
    total += sum;
    best = std::max(best, sum);
  }
  const std::size_t viewed = batch.sums.size() - summary.without_view;
  if (viewed == 0) return summary;
  summary.best_similarity = batch.similarity(best);
  summary.mean_similarity = static_cast<double>(total) / static_cast<double>(viewed) /
                            (static_cast<double>(batch.weight_scale) * batch.observed_pixels);
  return summary;
}

}  // namespace

Status ScoreSourceObservationModel::set_observation(const Observation& observation) {
  base_from_eye_ = observation.base_from_eye;
  return source_.set_observation(observation);
}

ScoreRequest ScoreSourceObservationModel::question(
    std::span<const localization::Particle> particles) const {
  ScoreRequest request;
  request.mode = strategy_ == localization::HeadingStrategy::kOdometry ? HeadingMode::kAsGiven
                                                                       : HeadingMode::kCompass;
  const bool distorted = std::ranges::any_of(
      particles, [](const localization::Particle& one) { return !one.affine.is_identity(); });
  request.poses.reserve(particles.size());
  for (const localization::Particle& particle : particles) {
    const Pose2& pose = particle.map_from_robot;
    request.poses.push_back(particle.affine.is_identity()
                                ? pose * base_from_eye_
                                : drawn_move(pose, pose * base_from_eye_, particle.affine));
    if (distorted) request.affines.push_back(particle.affine);
  }
  return request;
}

Result<ObservationWeights> ScoreSourceObservationModel::weigh(
    std::span<const localization::Particle> particles) {
  const bool combined = strategy_ == localization::HeadingStrategy::kCombined;
  const ScoreRequest request = question(particles);
  PoseCurves curves;
  if (combined) {
    SEMVIEW_TRY(curves, score_curves(source_, request));
  } else {
    SEMVIEW_TRY(curves.batch, source_.score(request));
    SEMVIEW_TRY_STATUS(check_shape(curves.batch, particles.size(), request));
  }
  const ScoreBatch& batch = curves.batch;

  const bool compass = request.mode == HeadingMode::kCompass;
  ObservationWeights weights;
  weights.log_weights.assign(particles.size(), kNothing);
  if (compass) weights.headings_rad.assign(particles.size(), kNothing);
  double lowest = kNothing;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (batch.sums[i] == kNoView) continue;
    HeadingChoice choice;
    if (combined) {
      const auto carried = particles[i].yaw_known
                               ? std::optional(particles[i].map_from_robot.yaw_rad)
                               : std::nullopt;
      choice = combine_heading(curves.of_pose(i), batch, carried, config_, combined_);
    } else {
      choice.log_weight = log_weight(config_, batch.similarity(batch.sums[i]));
      if (compass) choice.heading_rad = PoseGrid::heading_yaw_rad(batch.best_heading[i]);
    }
    weights.log_weights[i] = choice.log_weight;
    if (compass) weights.headings_rad[i] = choice.heading_rad;
    if (std::isfinite(choice.log_weight) && !(lowest <= choice.log_weight)) {
      lowest = choice.log_weight;
    }
  }
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (batch.sums[i] == kNoView) weights.log_weights[i] = lowest;
  }
  last_scores_ = summarize(batch);
  return weights;
}

}  // namespace semview::observation
