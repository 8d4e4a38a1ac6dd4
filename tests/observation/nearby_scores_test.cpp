// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/nearby_scores.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "semview/geometry/pose_grid.hpp"
#include "semview/observation/place_probe.hpp"

namespace semview::observation {
namespace {

/// A hill of similarity around `top`, quadratic in place and heading; no views left of `wall_x_m`.
class Hill final : public ScoreSource {
 public:
  Pose2 top;
  double wall_x_m = -100.0;
  double bend = 1.0;  ///< < 0: a hollow

  const ViewProfile& profile() const override { return profile_; }
  Status set_observation(const Observation&) override { return {}; }
  Result<ScoreBatch> score(const ScoreRequest& request) override {
    ScoreBatch batch;
    batch.weight_scale = 1000;
    batch.observed_pixels = 10000;
    for (const Pose2& pose : request.poses) {
      const Pose2 center = PoseGrid::center(*PoseGrid::cell(pose.x_m, pose.y_m));
      std::int32_t best = kNoView;
      for (int k = 0; k < PoseGrid::kHeadings; ++k) {
        const double off_rad = wrap_angle(PoseGrid::heading_yaw_rad(k) - top.yaw_rad);
        const double off_m = distance_m(center, top);
        const double value = 0.8 - bend * (0.5 * off_m * off_m + 0.3 * off_rad * off_rad);
        const bool viewed = center.x_m > wall_x_m;
        const auto sum = viewed ? static_cast<std::int32_t>(std::lround(value * 1e7)) : kNoView;
        best = std::max(best, sum);
        if (request.whole_curve) batch.curve.push_back(sum);
      }
      batch.sums.push_back(best);
      batch.best_heading.push_back(0);
    }
    return batch;
  }

 private:
  ViewProfile profile_;
};

TEST(NearbyScoresTest, ThePoseBetweenCellsAndHeadingsIsFound) {
  Hill hill;
  for (const double yaw_deg : {-179.6, 0.0, 44.0, 178.9}) {
    hill.top = {1.234, -0.567, rad_from_deg(yaw_deg)};
    const Pose2 believed{1.30, -0.50, wrap_angle(rad_from_deg(yaw_deg + 4.0))};
    const auto nearby = score_nearby(hill, believed, {});
    ASSERT_TRUE(nearby) << nearby.error().message;
    const auto refined = refined_pose(*nearby);
    ASSERT_TRUE(refined) << yaw_deg;
    EXPECT_NEAR(refined->x_m, hill.top.x_m, 1e-3);
    EXPECT_NEAR(refined->y_m, hill.top.y_m, 1e-3);
    EXPECT_NEAR(wrap_angle(refined->yaw_rad - hill.top.yaw_rad), 0.0, rad_from_deg(0.02));
    EXPECT_NEAR(*best_similarity(*nearby), 0.8, 0.003);
  }
}

TEST(NearbyScoresTest, WhereTheObservationSaysNoMoreThePoseStays) {
  Hill hill;
  hill.top = {1.0, 1.0, 0.0};
  EXPECT_FALSE(refined_pose(*score_nearby(hill, {1.3, 1.0, 0.0}, {}))) << "the top is too far off";
  hill.wall_x_m = 0.9;
  EXPECT_FALSE(refined_pose(*score_nearby(hill, {1.0, 1.0, 0.0}, {}))) << "a cell has no view";
  hill.wall_x_m = -100.0;
  hill.bend = -1.0;
  EXPECT_FALSE(refined_pose(*score_nearby(hill, {1.0, 1.0, 0.0}, {}))) << "a hollow has no top";
}

TEST(PlaceProbeTest, ComparesTheBelievedPlaceWithPlacesElsewhere) {
  Hill hill;
  hill.top = {1.05, 1.05, 0.5};
  std::vector<CellIndex> free;
  for (int ix = 0; ix < 30; ++ix) {
    for (int iy = 0; iy < 30; ++iy) free.push_back({ix, iy});
  }
  const std::vector<CellIndex> cells = probe_cells(free);
  EXPECT_EQ(cells.size(), 64U) << "every fourth along x and y";
  const auto right = probe_place(hill, {1.2, 0.9, 0.4}, cells, {});
  const auto wrong = probe_place(hill, {2.6, 2.6, 0.5}, cells, {});
  const auto turned = probe_place(hill, {1.2, 0.9, 2.0}, cells, {});
  ASSERT_TRUE(right && wrong && turned);
  EXPECT_NEAR(right->here, 0.8, 0.01);
  EXPECT_LT(right->elsewhere, 0.7) << "1 m from the pose";
  EXPECT_NEAR(wrong->elsewhere, 0.8, 0.001) << "between the probe cells, too";
  EXPECT_LT(wrong->here, 0.4);
  EXPECT_LT(turned->here, 0.65) << "only headings near the pose's";
  EXPECT_EQ(right->mean, wrong->mean);
  EXPECT_LT(right->mean, right->elsewhere);
}

TEST(PlaceProbeTest, ManyCellsAreThinnedAndFewAreAllTaken) {
  std::vector<CellIndex> free;
  for (int ix = 0; ix < 400; ++ix) {
    for (int iy = 0; iy < 400; ++iy) free.push_back({ix, iy});
  }
  EXPECT_EQ(probe_cells(free).size(), 625U) << "one in 1.6 m";
  EXPECT_EQ(probe_cells({{1, 1}, {2, 3}}).size(), 2U);
  EXPECT_TRUE(probe_cells({}).empty());
}

}  // namespace
}  // namespace semview::observation
