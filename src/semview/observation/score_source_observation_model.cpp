// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/score_source_observation_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "semview/geometry/pose_grid.hpp"

namespace semview::observation {
namespace {

using localization::ObservationWeights;

Status check_shape(const ScoreBatch& batch, std::size_t poses, bool compass) {
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

Result<ObservationWeights> ScoreSourceObservationModel::weigh(std::span<const Pose2> poses) {
  const bool compass = strategy_ == localization::HeadingStrategy::kCompass;
  ScoreRequest request;
  request.poses.reserve(poses.size());
  for (const Pose2& pose : poses) request.poses.push_back(pose * base_from_eye_);
  request.mode = compass ? HeadingMode::kCompass : HeadingMode::kAsGiven;
  SEMVIEW_TRY(const ScoreBatch batch, source_.score(request));
  SEMVIEW_TRY_STATUS(check_shape(batch, poses.size(), compass));

  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  ObservationWeights weights;
  weights.log_weights.assign(poses.size(), kNothing);
  double lowest = kNothing;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (batch.sums[i] == kNoView) continue;
    const double value = log_weight(config_, batch.similarity(batch.sums[i]));
    weights.log_weights[i] = value;
    if (std::isfinite(value) && !(lowest <= value)) lowest = value;
  }
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (batch.sums[i] == kNoView) weights.log_weights[i] = lowest;
  }
  if (compass) {
    weights.headings_rad.reserve(poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
      weights.headings_rad.push_back(
          batch.sums[i] == kNoView ? kNothing : PoseGrid::heading_yaw_rad(batch.best_heading[i]));
    }
  }
  last_scores_ = summarize(batch);
  return weights;
}

}  // namespace semview::observation
