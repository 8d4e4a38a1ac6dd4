// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/pose_curves.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "semview/core/random.hpp"

namespace semview::observation {
namespace {

/// Sums that follow from cell, distortion and heading alone.
class CellSums final : public ScoreSource {
 public:
  std::vector<std::size_t> asked;  ///< poses of each call

  const ViewProfile& profile() const override { return profile_; }
  Status set_observation(const Observation&) override { return {}; }
  Result<ScoreBatch> score(const ScoreRequest& request) override {
    asked.push_back(request.poses.size());
    ScoreBatch batch;
    batch.weight_scale = 10;
    batch.observed_pixels = 100;
    for (std::size_t i = 0; i < request.poses.size(); ++i) {
      const CellIndex cell = *PoseGrid::cell(request.poses[i].x_m, request.poses[i].y_m);
      const AffineSteps steps =
          request.affines.empty() ? AffineSteps{} : affine_steps(request.affines[i]);
      for (int k = 0; k < PoseGrid::kHeadings; ++k) {
        batch.curve.push_back(cell.ix * 7919 + cell.iy * 104729 + steps.a * 31 + k);
      }
      batch.sums.push_back(batch.curve.back());
      batch.best_heading.push_back(PoseGrid::kHeadings - 1);
      ++batch.origins.memory;
    }
    return batch;
  }

 private:
  ViewProfile profile_;
};

ScoreRequest cloud(std::size_t poses, double spread_m, bool distorted) {
  Rng rng(1, "cloud");
  ScoreRequest request;
  for (std::size_t i = 0; i < poses; ++i) {
    request.poses.push_back({rng.uniform(0.0, spread_m), rng.uniform(0.0, spread_m), 0.0});
    if (distorted) request.affines.push_back({.a = rng.uniform(0.97, 1.03)});
  }
  return request;
}

TEST(PoseCurvesTest, EachCellIsAskedForOnceAndEveryPoseHasItsCurve) {
  for (const bool distorted : {false, true}) {
    ScoreRequest request = cloud(400, 0.5, distorted);
    CellSums source;
    const auto curves = score_curves(source, request);
    ASSERT_TRUE(curves) << curves.error().message;
    ASSERT_EQ(source.asked.size(), 1U);
    EXPECT_LE(source.asked[0], distorted ? 25U * 5U : 25U);
    request.mode = HeadingMode::kCompass;
    request.whole_curve = true;
    const ScoreBatch each = *source.score(request);
    EXPECT_EQ(curves->batch.sums, each.sums);
    EXPECT_EQ(curves->batch.best_heading, each.best_heading);
    for (std::size_t i = 0; i < request.poses.size(); ++i) {
      const auto expected =
          std::span(each.curve).subspan(i * PoseGrid::kHeadings, PoseGrid::kHeadings);
      ASSERT_TRUE(std::ranges::equal(curves->of_pose(i), expected)) << i;
    }
  }
}

TEST(PoseCurvesTest, ManyCellsAreAskedForInSeveralCalls) {
  CellSums source;
  const ScoreRequest request = cloud(9000, 500.0, false);
  const auto curves = score_curves(source, request);
  ASSERT_TRUE(curves);
  EXPECT_EQ(source.asked.size(), 3U);
  EXPECT_EQ(curves->batch.sums.size(), 9000U);
  EXPECT_EQ(curves->batch.origins.total(), curves->batch.curve.size() / PoseGrid::kHeadings);
}

TEST(PoseCurvesTest, APoseBeyondTheGridIsNamed) {
  CellSums source;
  ScoreRequest request = cloud(3, 1.0, false);
  request.poses[1].x_m = std::numeric_limits<double>::quiet_NaN();
  const auto curves = score_curves(source, request);
  ASSERT_FALSE(curves);
  EXPECT_EQ(curves.error().field, "poses");
}

}  // namespace
}  // namespace semview::observation
