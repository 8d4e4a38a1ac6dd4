// SPDX-License-Identifier: Apache-2.0
#include "semview/field/depth_scores.hpp"

#include <algorithm>
#include <span>

#include "semview/geometry/pose_grid.hpp"

namespace semview::field {
namespace {

/// Steps of a similarity; -8 fits a score's 32 bits.
constexpr std::int32_t kScale = 1 << 20;
/// Places whose headings are scored at once: their poses and losses take some 15 MB.
constexpr std::size_t kPlacesAtOnce = 4096;
constexpr std::size_t kHeadings = PoseGrid::kHeadings;

/// The mean of a pixel in units of 1 / kScale, rounded.
std::int32_t sum_of(std::int64_t loss, std::int64_t pixels) {
  const std::int64_t unit = pixels * kUnitsPerNat;
  return static_cast<std::int32_t>(-((loss * kScale + unit / 2) / unit));
}

/// Each place at all headings of the grid.
std::vector<Pose2> turned(std::span<const Pose2> places) {
  std::vector<Pose2> poses;
  poses.reserve(places.size() * kHeadings);
  for (const Pose2& place : places) {
    for (int k = 0; k < PoseGrid::kHeadings; ++k) {
      poses.push_back({place.x_m, place.y_m, PoseGrid::heading_yaw_rad(k)});
    }
  }
  return poses;
}

Status score_compass(const FieldLikelihood& likelihood,
                     const FieldObservation& observation,
                     const ScoreRequest& request,
                     ThreadPool& pool,
                     ScoreBatch& batch) {
  const std::span<const Pose2> places(request.poses);
  for (std::size_t first = 0; first < places.size(); first += kPlacesAtOnce) {
    const auto some = places.subspan(first, std::min(kPlacesAtOnce, places.size() - first));
    SEMVIEW_TRY(const FieldScores scores, likelihood.score(observation, turned(some), pool));
    for (std::size_t i = 0; i < some.size(); ++i) {
      const auto losses = std::span(scores.losses).subspan(i * kHeadings, kHeadings);
      const auto best = std::ranges::min_element(losses);
      batch.sums[first + i] = sum_of(*best, scores.pixels);
      batch.best_heading[first + i] = static_cast<std::uint8_t>(best - losses.begin());
      if (!request.whole_curve) continue;
      for (std::size_t k = 0; k < kHeadings; ++k) {
        batch.curve[(first + i) * kHeadings + k] = sum_of(losses[k], scores.pixels);
      }
    }
  }
  return {};
}

}  // namespace

ScoreBatch unscored_depth_batch(const ScoreRequest& request) {
  const std::size_t poses = request.poses.size();
  ScoreBatch batch;
  batch.weight_scale = kScale;
  batch.observed_pixels = 1;
  batch.sums.assign(poses, kNoView);
  if (request.mode == HeadingMode::kCompass) batch.best_heading.resize(poses);
  if (request.whole_curve) batch.curve.resize(poses * kHeadings);
  return batch;
}

Result<ScoreBatch> score_depth(const FieldLikelihood& likelihood,
                               const FieldObservation& observation,
                               const ScoreRequest& request,
                               ThreadPool& pool) {
  if (std::ranges::any_of(request.affines,
                          [](const MapAffine& one) { return !one.is_identity(); })) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      "depth is scored on maps as they are, not distorted",
                      "affines"});
  }
  ScoreBatch batch = unscored_depth_batch(request);
  if (request.mode == HeadingMode::kCompass) {
    SEMVIEW_TRY_STATUS(score_compass(likelihood, observation, request, pool, batch));
    return batch;
  }
  SEMVIEW_TRY(const FieldScores scores, likelihood.score(observation, request.poses, pool));
  std::ranges::transform(scores.losses, batch.sums.begin(), [&scores](std::int64_t loss) {
    return sum_of(loss, scores.pixels);
  });
  return batch;
}

}  // namespace semview::field
