// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/score_poses.hpp"

#include <algorithm>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference/literal_similarity.hpp"
#include "semview/similarity/similarity_score_source.hpp"
#include "similarity/fake_view_source.hpp"

namespace semview::similarity {
namespace {

class ScorePosesTest : public testing::Test {
 protected:
  ScorePosesTest() {
    Rng rng(5);
    observation_ = random_observation(rng, camera(), observed_, 15, 100, 0.2);
    weights_ = random_weights(rng, observed_, map_, 2, 1.0);
    for (int i = 0; i < 300; ++i) {
      request_.poses.push_back(
          {rng.uniform(-0.6, 0.9), rng.uniform(-0.3, 0.3), rng.uniform(-3.1, 3.1)});
    }
  }

  const PanoramaCamera& camera() const { return views_.profile().camera; }

  ScoreBatch score(std::size_t threads) {
    ThreadPool pool(threads);
    const auto prepared = PreparedObservation::build(observation_, *weights_, map_, camera());
    return score_poses(prepared.value(), views_, request_, pool).value();
  }

  std::int32_t literal(const Pose2& pose, int heading) {
    const SharedView view = views_.view(PoseGrid::key(pose)->cell);
    if (!view) return kNoView;
    return reference::literal_sum(observation_, *weights_, map_, camera(), *view, heading);
  }

  ClassTable observed_ = numbered_classes("seen", 4);
  ClassTable map_ = numbered_classes("map", 3);
  FakeViewSource views_{3};
  Observation observation_;
  std::optional<WeightMatrix> weights_;
  ScoreRequest request_;
};

TEST_F(ScorePosesTest, EachPoseHasTheSumOfItsOwnCellAndHeading) {
  const ScoreBatch batch = score(1);
  ASSERT_EQ(batch.sums.size(), request_.poses.size());
  EXPECT_TRUE(batch.best_heading.empty());
  EXPECT_TRUE(batch.curve.empty());
  for (std::size_t i = 0; i < batch.sums.size(); ++i) {
    const Pose2& pose = request_.poses[i];
    EXPECT_EQ(batch.sums[i], literal(pose, PoseGrid::key(pose)->heading)) << i;
  }
}

TEST_F(ScorePosesTest, TheCompassReportsTheBestOfAllHeadingsAndTheWholeCurve) {
  request_.mode = HeadingMode::kCompass;
  request_.whole_curve = true;
  request_.poses.resize(20);
  const ScoreBatch batch = score(1);
  for (std::size_t i = 0; i < batch.sums.size(); ++i) {
    const Pose2& pose = request_.poses[i];
    std::vector<std::int32_t> curve;
    for (int k = 0; k < PoseGrid::kHeadings; ++k) curve.push_back(literal(pose, k));
    const std::vector<std::int32_t> ours(
        batch.curve.begin() + static_cast<std::ptrdiff_t>(i * 120),
        batch.curve.begin() + static_cast<std::ptrdiff_t>(i * 120 + 120));
    EXPECT_EQ(ours, curve) << i;
    EXPECT_EQ(batch.sums[i], *std::ranges::max_element(curve));
    if (batch.sums[i] == kNoView) {
      EXPECT_EQ(batch.best_heading[i], PoseGrid::key(pose)->heading);
    } else {
      EXPECT_EQ(batch.best_heading[i], std::ranges::max_element(curve) - curve.begin());
    }
  }
}

TEST_F(ScorePosesTest, EachCellIsAskedForOnceHoweverManyPosesStandInIt) {
  const ScoreBatch batch = score(2);
  for (const auto& [cell, times] : views_.asked()) EXPECT_EQ(times, 1) << cell.ix << " " << cell.iy;
  EXPECT_EQ(batch.origins.total(), views_.asked().size());
  EXPECT_LT(batch.origins.total(), request_.poses.size());
}

TEST_F(ScorePosesTest, TheNumberOfThreadsChangesNothing) {
  request_.mode = HeadingMode::kCompass;
  const ScoreBatch one = score(1);
  const ScoreBatch four = score(4);
  EXPECT_EQ(one.sums, four.sums);
  EXPECT_EQ(one.best_heading, four.best_heading);
}

TEST_F(ScorePosesTest, OfEqualHeadingsTheLowestIsTheBest) {
  request_.mode = HeadingMode::kCompass;
  WeightMatrix::Band band;
  band.weights.assign(4 * 4, 0.5);
  weights_ = WeightMatrix::build(
                 {"seen0", "seen1", "seen2", "seen3"}, {"map0", "map1", "map2", "none"}, {band})
                 .value();
  const ScoreBatch batch = score(1);
  for (std::size_t i = 0; i < batch.sums.size(); ++i) {
    if (batch.sums[i] == kNoView) continue;
    EXPECT_EQ(batch.best_heading[i], 0);
  }
}

TEST_F(ScorePosesTest, AnEmptyBatchIsAnEmptyAnswer) {
  request_.poses.clear();
  EXPECT_TRUE(score(1).sums.empty());
}

TEST_F(ScorePosesTest, APoseThatIsNotFiniteIsNamed) {
  request_.poses[7].yaw_rad = std::numeric_limits<double>::quiet_NaN();
  ThreadPool pool(1);
  const auto prepared = PreparedObservation::build(observation_, *weights_, map_, camera());
  const auto batch = score_poses(*prepared, views_, request_, pool);
  ASSERT_FALSE(batch);
  EXPECT_EQ(batch.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(batch.error().field, "poses");
  EXPECT_THAT(batch.error().message, testing::HasSubstr("pose 7"));
}

TEST_F(ScorePosesTest, ViewsOfAnotherMapAreAnErrorNotARead) {
  FakeViewSource foreign{9};
  ThreadPool pool(1);
  const auto prepared = PreparedObservation::build(observation_, *weights_, map_, camera());
  const auto batch = score_poses(*prepared, foreign, request_, pool);
  ASSERT_FALSE(batch);
  EXPECT_EQ(batch.error().code, ErrorCode::kInternal);
}

TEST_F(ScorePosesTest, TheScoreSourceNeedsAnObservationFirst) {
  ThreadPool pool(1);
  SimilarityScoreSource source(views_, map_, *weights_, pool);
  const auto without = source.score(request_);
  ASSERT_FALSE(without);
  EXPECT_EQ(without.error().code, ErrorCode::kFailedPrecondition);
  ASSERT_TRUE(source.set_observation(observation_));
  EXPECT_EQ(source.score(request_)->sums, score(1).sums);
}

}  // namespace
}  // namespace semview::similarity
