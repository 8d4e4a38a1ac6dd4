// SPDX-License-Identifier: Apache-2.0
#include "semview/evaluation/run_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace semview::evaluation {
namespace {

ErrorSummary summarise(std::vector<double> errors) {
  ErrorSummary summary;
  summary.final = errors.back();
  summary.mean =
      std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
  std::ranges::sort(errors);
  const std::size_t middle = errors.size() / 2;
  summary.median =
      errors.size() % 2 == 1 ? errors[middle] : 0.5 * (errors[middle - 1] + errors[middle]);
  summary.max = errors.back();
  return summary;
}

bool covers(std::span<const io::StampedPose2> poses, double stamp_s) {
  return !poses.empty() && stamp_s >= poses.front().stamp_s && stamp_s <= poses.back().stamp_s;
}

}  // namespace

Result<TrackErrors> compare(std::span<const io::StampedPose2> poses,
                            std::span<const io::StampedPose2> groundtruth,
                            double converged_within_m) {
  TrackErrors result;
  std::vector<double> position_m;
  std::vector<double> heading_rad;
  std::optional<double> first_s;
  std::optional<double> within_since_s;
  for (const io::StampedPose2& sample : poses) {
    if (!covers(groundtruth, sample.stamp_s)) {
      ++result.skipped;
      continue;
    }
    SEMVIEW_TRY(const Pose2 truth, io::interpolate(groundtruth, sample.stamp_s));
    position_m.push_back(distance_m(sample.pose, truth));
    heading_rad.push_back(std::abs(wrap_angle(sample.pose.yaw_rad - truth.yaw_rad)));
    if (!first_s) first_s = sample.stamp_s;
    // NaN is never within: written so that it ends a stretch.
    if (!(position_m.back() < converged_within_m)) {
      within_since_s.reset();
    } else if (!within_since_s) {
      within_since_s = sample.stamp_s;
    }
  }
  if (position_m.empty()) {
    return fail(
        ErrorCode::kOutOfRange,
        fmt::format("none of the {} poses lies within the time of the ground truth", poses.size()));
  }
  result.stamps = position_m.size();
  result.position_m = summarise(std::move(position_m));
  result.heading_rad = summarise(std::move(heading_rad));
  if (within_since_s) result.converged_after_s = *within_since_s - *first_s;
  return result;
}

Result<std::vector<io::StampedPose2>> align_odometry(
    std::span<const io::StampedPose2> odometry, std::span<const io::StampedPose2> groundtruth) {
  if (odometry.empty() || groundtruth.empty()) {
    return fail(ErrorCode::kOutOfRange, "no odometry or no ground truth");
  }
  const double start_s = std::max(odometry.front().stamp_s, groundtruth.front().stamp_s);
  if (!covers(odometry, start_s) || !covers(groundtruth, start_s)) {
    return fail(ErrorCode::kOutOfRange, "odometry and ground truth have no time in common");
  }
  SEMVIEW_TRY(const Pose2 odom_from_base, io::interpolate(odometry, start_s));
  SEMVIEW_TRY(const Pose2 map_from_base, io::interpolate(groundtruth, start_s));
  const Pose2 map_from_odom = map_from_base * inverse(odom_from_base);
  std::vector<io::StampedPose2> aligned;
  aligned.reserve(odometry.size());
  for (const io::StampedPose2& sample : odometry) {
    if (sample.stamp_s >= start_s) {
      aligned.push_back({sample.stamp_s, map_from_odom * sample.pose});
    }
  }
  return aligned;
}

std::vector<io::StampedPose2> sample(std::span<const io::StampedPose2> poses,
                                     std::span<const io::StampedPose2> at) {
  std::vector<io::StampedPose2> sampled;
  for (const io::StampedPose2& moment : at) {
    if (const Result<Pose2> pose = io::interpolate(poses, moment.stamp_s)) {
      sampled.push_back({moment.stamp_s, *pose});
    }
  }
  return sampled;
}

}  // namespace semview::evaluation
