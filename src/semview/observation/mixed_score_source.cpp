// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/mixed_score_source.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "semview/geometry/pose_grid.hpp"

namespace semview::observation {
namespace {

/// Steps of a similarity. 8 nats of as many pixels as there may be, and the views', fit 32 bits.
constexpr std::int32_t kScale = 1 << 16;
constexpr double kMostPixels = 2000.0;
constexpr double kMostKappa = 1000.0;
constexpr std::size_t kHeadings = PoseGrid::kHeadings;
/// Places whose headings are asked for in one request; servers take 200 000 poses.
constexpr std::size_t kPlacesAtOnce = 1000;

bool in_range(double value, double most) { return value > 0.0 && value <= most; }

Status check_size(std::size_t views, std::size_t depths, std::size_t expected) {
  if (views == expected && depths == expected) return {};
  return fail(ErrorCode::kInternal,
              fmt::format("the score sources answered {} sums of views and {} of depth, expected "
                          "{} of each",
                          views,
                          depths,
                          expected));
}

}  // namespace

Status validate(const MixedConfig& config) {
  const auto refuse = [](const char* field, double value, double most) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("{} {}: expected more than 0, at most {}", field, value, most),
                      field});
  };
  if (!in_range(config.views_kappa, kMostKappa)) {
    return refuse("kappa", config.views_kappa, kMostKappa);
  }
  if (!in_range(config.effective_pixels, kMostPixels)) {
    return refuse("effective-pixels", config.effective_pixels, kMostPixels);
  }
  return {};
}

Status MixedScoreSource::set_observation(const Observation& observation) {
  eye_from_base_ = inverse(observation.base_from_eye);
  SEMVIEW_TRY_STATUS(views_->set_observation(observation));
  return depth_->set_observation(observation);
}

/// At each pose, or at all headings of each. The base turns around the eye, not the eye around it,
/// so that a compass of the depth source would not do.
Result<ScoreBatch> MixedScoreSource::depth_of(const ScoreRequest& request) {
  const bool compass = request.mode == HeadingMode::kCompass;
  const std::size_t each = compass ? kHeadings : 1;
  const std::size_t at_once =
      compass ? kPlacesAtOnce : std::max<std::size_t>(request.poses.size(), 1);
  ScoreBatch whole;
  for (std::size_t first = 0; first < request.poses.size(); first += at_once) {
    ScoreRequest some;
    const std::size_t end = std::min(first + at_once, request.poses.size());
    for (std::size_t i = first; i < end; ++i) {
      Pose2 eye = request.poses[i];
      for (std::size_t k = 0; k < each; ++k) {
        if (compass) eye.yaw_rad = PoseGrid::heading_yaw_rad(static_cast<int>(k));
        some.poses.push_back(eye * eye_from_base_);
        if (!request.affines.empty()) some.affines.push_back(request.affines[i]);
      }
    }
    SEMVIEW_TRY(ScoreBatch part, depth_->score(some));
    part.sums.insert(part.sums.begin(), whole.sums.begin(), whole.sums.end());
    whole = std::move(part);
  }
  return whole;
}

Result<ScoreBatch> MixedScoreSource::score(const ScoreRequest& request) {
  const bool compass = request.mode == HeadingMode::kCompass;
  ScoreRequest of_views = request;
  of_views.whole_curve = compass;
  SEMVIEW_TRY(const ScoreBatch views, views_->score(of_views));
  SEMVIEW_TRY(const ScoreBatch depth, depth_of(request));
  const std::vector<std::int32_t>& view_sums = compass ? views.curve : views.sums;
  const std::size_t each = compass ? kHeadings : 1;
  SEMVIEW_TRY_STATUS(check_size(view_sums.size(), depth.sums.size(), request.poses.size() * each));
  std::vector<std::int32_t> sums(view_sums.size());
  std::ranges::transform(
      view_sums, depth.sums, sums.begin(), [&](std::int32_t of_view, std::int32_t of_depth) {
        if (of_view == kNoView || of_depth == kNoView) return kNoView;
        const double log_likelihood = config_.views_kappa * views.similarity(of_view) +
                                      config_.effective_pixels * depth.similarity(of_depth);
        return static_cast<std::int32_t>(std::lround(log_likelihood * kScale));
      });
  ScoreBatch batch;
  batch.weight_scale = kScale;
  batch.observed_pixels = 1;
  batch.origins = views.origins;
  if (!compass) {
    batch.sums = std::move(sums);
    return batch;
  }
  for (std::size_t i = 0; i < request.poses.size(); ++i) {
    const auto curve = std::span(sums).subspan(i * kHeadings, kHeadings);
    const auto best = std::ranges::max_element(curve);
    batch.sums.push_back(*best);
    batch.best_heading.push_back(static_cast<std::uint8_t>(best - curve.begin()));
  }
  if (request.whole_curve) batch.curve = std::move(sums);
  return batch;
}

}  // namespace semview::observation
