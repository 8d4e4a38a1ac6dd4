// SPDX-License-Identifier: Apache-2.0
/// A score source that knows where the robot is, and can be switched off.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "semview/geometry/pose_grid.hpp"
#include "semview/view/score_source.hpp"

namespace semview::robot {

/// Similarity falls linearly with the distance from `truth`, to 0 at `reach_m` and below 0 after
/// it; as given, and along a curve, also with the difference in heading. The compass always finds
/// the true heading.
class FakeScoreSource final : public ScoreSource {
 public:
  Pose2 truth;
  double reach_m = 3.0;
  std::optional<Error> broken;  ///< what every call answers while it is set
  int calls = 0;

  const ViewProfile& profile() const override { return profile_; }

  Status set_observation(const Observation&) override {
    if (broken) return fail(*broken);
    return {};
  }

  Result<ScoreBatch> score(const ScoreRequest& request) override {
    if (broken) return fail(*broken);
    ++calls;
    ScoreBatch batch;
    batch.weight_scale = 100;
    batch.observed_pixels = 10000;
    batch.origins.memory = request.poses.size();
    const bool compass = request.mode == HeadingMode::kCompass;
    for (const Pose2& pose : request.poses) {
      double similarity = 1.0 - distance_m(pose, truth) / reach_m;
      if (!compass) similarity -= std::abs(wrap_angle(pose.yaw_rad - truth.yaw_rad));
      batch.sums.push_back(
          static_cast<std::int32_t>(std::lround(1.0e6 * std::max(-1.0, similarity))));
      if (compass) {
        batch.best_heading.push_back(static_cast<std::uint8_t>(PoseGrid::heading(truth.yaw_rad)));
      }
      for (int k = 0; request.whole_curve && k < PoseGrid::kHeadings; ++k) {
        const double turn_rad = std::abs(wrap_angle(PoseGrid::heading_yaw_rad(k) - truth.yaw_rad));
        batch.curve.push_back(
            static_cast<std::int32_t>(std::lround(1.0e6 * std::max(-1.0, similarity - turn_rad))));
      }
    }
    return batch;
  }

 private:
  ViewProfile profile_;
};

/// An observation with one pixel known, enough to be worth a question.
inline Observation something() {
  Observation observation;
  observation.labels = LabelImage(90, 360, kUnknown);
  observation.labels.at(45, 180) = 1;
  return observation;
}

}  // namespace semview::robot
