// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/score_distorted.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "reference/literal_similarity.hpp"
#include "semview/similarity/similarity_score_source.hpp"
#include "similarity/fake_view_source.hpp"

namespace semview::similarity {
namespace {

class ScoreDistortedTest : public testing::Test {
 protected:
  ScoreDistortedTest() {
    Rng rng(6);
    observation_ = random_observation(rng, camera(), observed_, 15, 100, 0.2);
    weights_ = random_weights(rng, observed_, map_, 2, 1.0);
    const MapAffine kinds[] = {{}, {.a = 1.1}, {.a = 1.1, .b = 0.9}, {.k = 0.2}};
    for (int i = 0; i < 200; ++i) {
      request_.poses.push_back(
          {rng.uniform(-0.6, 0.9), rng.uniform(-0.3, 0.3), rng.uniform(-3.1, 3.1)});
      request_.affines.push_back(kinds[rng.below(4)]);
    }
  }

  const PanoramaCamera& camera() const { return views_.profile().camera; }

  Result<ScoreBatch> score(std::size_t threads) {
    ThreadPool pool(threads);
    SimilarityScoreSource source(views_, map_, *weights_, pool);
    SEMVIEW_TRY_STATUS(source.set_observation(observation_));
    return source.score(request_);
  }

  std::int32_t literal(std::size_t i, int heading) {
    const SharedView view =
        views_.view(PoseGrid::key(request_.poses[i])->cell, on_affine_grid(request_.affines[i]));
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

TEST_F(ScoreDistortedTest, EachPoseIsComparedWithTheViewOfItsOwnDistortion) {
  const auto batch = score(1);
  ASSERT_TRUE(batch) << batch.error().message;
  for (std::size_t i = 0; i < request_.poses.size(); ++i) {
    EXPECT_EQ(batch->sums[i], literal(i, PoseGrid::key(request_.poses[i])->heading)) << i;
  }
}

TEST_F(ScoreDistortedTest, CompassAndCurvesStandWhereTheirPosesDo) {
  request_.mode = HeadingMode::kCompass;
  request_.whole_curve = true;
  const auto batch = score(1);
  ASSERT_TRUE(batch);
  for (std::size_t i = 0; i < request_.poses.size(); i += 17) {
    for (int k = 0; k < PoseGrid::kHeadings; ++k) {
      ASSERT_EQ(batch->curve[i * PoseGrid::kHeadings + static_cast<std::size_t>(k)], literal(i, k));
    }
    EXPECT_EQ(batch->sums[i], literal(i, batch->best_heading[i]));
  }
}

TEST_F(ScoreDistortedTest, ThreadsChangeNothing) {
  request_.mode = HeadingMode::kCompass;
  const auto one = score(1);
  const auto three = score(3);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(one->sums, three->sums);
  EXPECT_EQ(one->best_heading, three->best_heading);
}

TEST_F(ScoreDistortedTest, AMapThatIsExactGivesTheScoresOfPlainPoses) {
  request_.affines.assign(request_.poses.size(), MapAffine{.a = 1.004});
  const auto distorted = score(1);
  request_.affines.clear();
  const auto plain = score(1);
  ASSERT_TRUE(distorted && plain);
  EXPECT_EQ(distorted->sums, plain->sums);
}

TEST_F(ScoreDistortedTest, AnAffineOutOfRangeIsNamed) {
  request_.affines[3] = {.a = std::numeric_limits<double>::quiet_NaN()};
  const auto batch = score(1);
  EXPECT_EQ(batch.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(batch.error().field, "affines");
  EXPECT_NE(batch.error().message.find("affine 3"), std::string::npos) << batch.error().message;
}

TEST_F(ScoreDistortedTest, AnAffineForSomePosesOnlyIsAnError) {
  request_.affines.pop_back();
  const auto batch = score(1);
  EXPECT_EQ(batch.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(batch.error().field, "affines");
}

}  // namespace
}  // namespace semview::similarity
