// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/mixed_score_source.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "semview/geometry/pose_grid.hpp"

namespace semview::observation {
namespace {

/// A similarity that a function of the pose gives, in steps of 1 / 1000.
class FormulaSource final : public ScoreSource {
 public:
  using Formula = std::function<std::optional<double>(const Pose2&)>;

  explicit FormulaSource(Formula formula) : formula_(std::move(formula)) {}

  const ViewProfile& profile() const override { return profile_; }
  Status set_observation(const Observation&) override { return {}; }

  Result<ScoreBatch> score(const ScoreRequest& request) override {
    ScoreBatch batch;
    batch.weight_scale = 10;
    batch.observed_pixels = 100;
    for (Pose2 pose : request.poses) {
      if (request.mode == HeadingMode::kAsGiven) {
        batch.sums.push_back(sum_at(pose));
        continue;
      }
      std::vector<std::int32_t> curve;
      for (int k = 0; k < PoseGrid::kHeadings; ++k) {
        pose.yaw_rad = PoseGrid::heading_yaw_rad(k);
        curve.push_back(sum_at(pose));
      }
      const auto best = std::ranges::max_element(curve);
      batch.sums.push_back(*best);
      batch.best_heading.push_back(static_cast<std::uint8_t>(best - curve.begin()));
      if (request.whole_curve) batch.curve.insert(batch.curve.end(), curve.begin(), curve.end());
    }
    return batch;
  }

 private:
  std::int32_t sum_at(const Pose2& pose) const {
    const std::optional<double> similarity = formula_(pose);
    return similarity ? static_cast<std::int32_t>(std::lround(1000.0 * *similarity)) : kNoView;
  }

  Formula formula_;
  ViewProfile profile_;
};

constexpr MixedConfig kConfig{50.0, 200.0};

/// Views that like x = 1 and a heading of 60 degrees; depth that likes y = 2 and 66 degrees.
MixedScoreSource source() {
  const auto off = [](const Pose2& pose, double yaw_deg) {
    return std::abs(wrap_angle(pose.yaw_rad - rad_from_deg(yaw_deg)));
  };
  return {std::make_unique<FormulaSource>([off](const Pose2& eye) -> std::optional<double> {
            if (eye.x_m > 9.0) return std::nullopt;
            return 1.0 - 0.1 * std::abs(eye.x_m - 1.0) - 0.1 * off(eye, 60.0);
          }),
          std::make_unique<FormulaSource>([off](const Pose2& base) -> std::optional<double> {
            return -0.2 * std::abs(base.y_m - 2.0) - 0.1 * off(base, 66.0);
          }),
          kConfig};
}

TEST(MixedScoreSourceTest, AddsTheLogarithmsOfBoth) {
  MixedScoreSource mixed = source();
  ASSERT_TRUE(mixed.set_observation({}));
  const auto batch = mixed.score({{{1.5, 2.3, rad_from_deg(60.0)}, {9.5, 2.0, 0.0}}});
  ASSERT_TRUE(batch) << batch.error().message;
  EXPECT_NEAR(batch->similarity(batch->sums[0]),
              50.0 * 0.95 + 200.0 * (-0.06 - 0.1 * rad_from_deg(6.0)),
              200.0 * 5e-4 + 1e-4);  // the parts are whole thousandths
  EXPECT_EQ(batch->sums[1], kNoView);
}

TEST(MixedScoreSourceTest, DepthIsScoredAtTheBaseAndViewsAtTheEye) {
  MixedScoreSource mixed = source();
  Observation observation;
  observation.base_from_eye = {0.5, 0.0, 0.0};
  ASSERT_TRUE(mixed.set_observation(observation));
  // The eye looks along y: the base stands at y = 2 where the eye is at 2.5.
  const double yaw_rad = kPi / 2.0;
  const auto batch = mixed.score({{{1.0, 2.5, yaw_rad}, {1.0, 2.0, yaw_rad}}});
  ASSERT_TRUE(batch);
  EXPECT_NEAR(batch->similarity(batch->sums[0]) - batch->similarity(batch->sums[1]),
              200.0 * 0.2 * 0.5,
              0.3);
}

TEST(MixedScoreSourceTest, ACompassIsAllHeadingsAsGiven) {
  MixedScoreSource mixed = source();
  Observation observation;
  observation.base_from_eye = {0.3, -0.1, 0.2};
  ASSERT_TRUE(mixed.set_observation(observation));
  const std::vector<Pose2> places{{0.5, 1.0, 0.0}, {9.5, 0.0, 0.0}, {2.0, 3.0, 1.0}};
  const auto compass = mixed.score({places, HeadingMode::kCompass, true});
  ASSERT_TRUE(compass) << compass.error().message;
  ScoreRequest turned;
  for (const Pose2& place : places) {
    for (int k = 0; k < PoseGrid::kHeadings; ++k) {
      turned.poses.push_back({place.x_m, place.y_m, PoseGrid::heading_yaw_rad(k)});
    }
  }
  const auto each = mixed.score(turned);
  ASSERT_TRUE(each);
  EXPECT_EQ(compass->curve, each->sums);
  EXPECT_EQ(compass->sums[1], kNoView);
  const auto best = std::max_element(each->sums.begin(), each->sums.begin() + PoseGrid::kHeadings);
  EXPECT_EQ(compass->sums[0], *best);
  EXPECT_EQ(compass->best_heading[0], best - each->sums.begin());
  const auto short_answer = mixed.score({places, HeadingMode::kCompass, false});
  ASSERT_TRUE(short_answer);
  EXPECT_EQ(short_answer->best_heading, compass->best_heading);
  EXPECT_TRUE(short_answer->curve.empty());
}

TEST(MixedScoreSourceTest, NumbersOutOfRangeAreRefused) {
  EXPECT_TRUE(validate(MixedConfig{}));
  EXPECT_EQ(validate({0.0, 300.0}).error().field, "kappa");
  EXPECT_EQ(validate({60.0, 2001.0}).error().field, "effective-pixels");
  EXPECT_FALSE(validate({60.0, std::nan("")}));
}

}  // namespace
}  // namespace semview::observation
