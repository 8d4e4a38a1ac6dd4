// SPDX-License-Identifier: Apache-2.0
#include "semview/field/field_score_source.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "field/field_scene.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/observation/voxel_reduction.hpp"

namespace semview::field {
namespace {

const Pose2 kTruth = room().origin * Pose2{0.6, 1.1, 0.3};

Observation seen_from_truth() {
  Observation observation;
  observation.voxels = *observation::reduce(photograph(room(), kTruth));
  return observation;
}

class FieldScoreSourceTest : public ::testing::Test {
 protected:
  std::shared_ptr<FieldLikelihood> likelihood() const {
    return std::make_shared<FieldLikelihood>(*FieldLikelihood::make(
        std::shared_ptr<const DistanceField>(*distances_of_plan(room(), room_classes())), {}));
  }
  ScoreBatch score(const ScoreRequest& request) {
    FieldScoreSource source(likelihood(), {}, pool_);
    EXPECT_TRUE(source.set_observation(seen_from_truth()));
    return *source.score(request);
  }

  ThreadPool pool_{2};
};

TEST_F(FieldScoreSourceTest, TheSimilarityIsTheMeanLogLikelihoodOfAPixel) {
  const std::vector<Pose2> poses{kTruth, kTruth * Pose2{0.4, -0.2, 0.5}, {50.0, 50.0, 1.0}};
  const auto direct = likelihood();
  ASSERT_TRUE(direct->set_observation(*seen_from_truth().voxels, pool_));
  const FieldScores expected = *direct->score(poses, pool_);
  const ScoreBatch batch = score({poses, HeadingMode::kAsGiven});
  ASSERT_EQ(batch.sums.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_NEAR(batch.similarity(batch.sums[i]), expected.mean_log_likelihood(i), 1e-6);
  }
  EXPECT_GT(batch.sums[0], batch.sums[1]);
}

TEST_F(FieldScoreSourceTest, ACompassIsAllHeadingsAsGiven) {
  const ScoreBatch compass = score({{kTruth, {}}, HeadingMode::kCompass, true});
  ScoreRequest turned;
  for (const Pose2& place : {kTruth, Pose2{}}) {
    for (int k = 0; k < PoseGrid::kHeadings; ++k) {
      turned.poses.push_back({place.x_m, place.y_m, PoseGrid::heading_yaw_rad(k)});
    }
  }
  const ScoreBatch each = score(turned);
  EXPECT_EQ(compass.curve, each.sums);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto first = each.sums.begin() + static_cast<std::ptrdiff_t>(i * PoseGrid::kHeadings);
    const auto best = std::max_element(first, first + PoseGrid::kHeadings);
    EXPECT_EQ(compass.sums[i], *best);
    EXPECT_EQ(compass.best_heading[i], best - first);
  }
}

TEST_F(FieldScoreSourceTest, ThePlaceOfTheCameraIsTheBestOfItsSurroundings) {
  ScoreRequest request;
  for (int dx = -2; dx <= 2; ++dx) {
    for (int dy = -2; dy <= 2; ++dy) request.poses.push_back(kTruth * Pose2{0.3 * dx, 0.3 * dy, 0});
  }
  const ScoreBatch batch = score(request);
  EXPECT_EQ(std::ranges::max_element(batch.sums) - batch.sums.begin(), 12);
}

TEST_F(FieldScoreSourceTest, AnObservationWithoutDepthIsRefused) {
  FieldScoreSource source(likelihood(), {}, pool_);
  const Status status = source.set_observation({});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message, "the observation has no depth");
}

TEST_F(FieldScoreSourceTest, ADistortedMapIsRefused) {
  FieldScoreSource source(likelihood(), {}, pool_);
  ASSERT_TRUE(source.set_observation(seen_from_truth()));
  ScoreRequest request{{kTruth}, HeadingMode::kAsGiven};
  request.affines = {MapAffine{1.1, 1.0, 0.0}};
  EXPECT_FALSE(source.score(request));
}

}  // namespace
}  // namespace semview::field
