// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/score_source_observation_model.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "semview/geometry/pose_grid.hpp"

namespace semview::observation {
namespace {

using localization::HeadingStrategy;

/// Answers what the test wrote down.
class Scripted final : public ScoreSource {
 public:
  ScoreBatch batch;
  ScoreRequest asked;
  ViewProfile profile_;

  const ViewProfile& profile() const override { return profile_; }
  Status set_observation(const Observation&) override { return {}; }
  Result<ScoreBatch> score(const ScoreRequest& request) override {
    asked = request;
    return batch;
  }
};

localization::ParticleSet particles_at(const std::vector<Pose2>& poses) {
  localization::ParticleSet particles;
  for (const Pose2& pose : poses) particles.push_back({.map_from_robot = pose});
  return particles;
}

ScoreBatch batch_of(std::vector<std::int32_t> sums) {
  ScoreBatch batch;
  batch.weight_scale = 10;
  batch.observed_pixels = 100;
  batch.best_heading.assign(sums.size(), 30);
  batch.sums = std::move(sums);
  batch.origins = {1, 2, 3};
  return batch;
}

TEST(SimilarityWeightingTest, PowerClipsNegativeSimilarityToImpossible) {
  const SimilarityWeightingConfig config{.transform = WeightTransform::kPower, .power = 12.0};
  EXPECT_NEAR(log_weight(config, 0.5), 12.0 * std::log(0.5), 1e-12);
  EXPECT_EQ(log_weight(config, 0.0), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(log_weight(config, -0.3), -std::numeric_limits<double>::infinity());
}

TEST(SimilarityWeightingTest, ExponentialKeepsNegativeSimilaritiesApart) {
  const SimilarityWeightingConfig config{.transform = WeightTransform::kExponential, .kappa = 20.0};
  EXPECT_NEAR(log_weight(config, 0.25), 5.0, 1e-12);
  EXPECT_NEAR(log_weight(config, -0.5), -10.0, 1e-12);
}

TEST(SimilarityWeightingTest, ParametersOutOfRangeAreNamed) {
  EXPECT_EQ(validate(SimilarityWeightingConfig{.power = 0.0}).error().field, "power");
  EXPECT_EQ(validate(SimilarityWeightingConfig{.kappa = -1.0}).error().field, "kappa");
  EXPECT_TRUE(validate(SimilarityWeightingConfig{}));
}

TEST(ScoreSourceObservationModelTest, WeighsBySimilarityAndSummarises) {
  Scripted source;
  source.batch = batch_of({500, 1000, kNoView});
  ScoreSourceObservationModel model(source, HeadingStrategy::kOdometry, {.power = 2.0});
  const std::vector<Pose2> poses{{0, 0, 0}, {1, 0, 1}, {2, 0, 2}};
  const auto weights = model.weigh(particles_at(poses));
  ASSERT_TRUE(weights);
  EXPECT_NEAR(weights->log_weights[0], 2.0 * std::log(0.5), 1e-12);
  EXPECT_NEAR(weights->log_weights[1], 0.0, 1e-12);
  EXPECT_NEAR(weights->log_weights[2], 2.0 * std::log(0.5), 1e-12) << "the lowest of the batch";
  EXPECT_TRUE(weights->headings_rad.empty());
  EXPECT_EQ(source.asked.poses, poses);
  EXPECT_EQ(source.asked.mode, HeadingMode::kAsGiven);
  EXPECT_NEAR(model.last_scores().best_similarity, 1.0, 1e-12);
  EXPECT_NEAR(model.last_scores().mean_similarity, 0.75, 1e-12);
  EXPECT_EQ(model.last_scores().without_view, 1U);
  EXPECT_EQ(model.last_scores().origins, (ViewOrigins{1, 2, 3}));
}

TEST(ScoreSourceObservationModelTest, PoseWithoutViewIsNotBetterThanAnyPossibleOne) {
  Scripted source;
  source.batch = batch_of({-500, 800, 300, kNoView});
  ScoreSourceObservationModel model(source, HeadingStrategy::kOdometry, {.power = 1.0});
  const auto weights = model.weigh(localization::ParticleSet(4));
  ASSERT_TRUE(weights);
  EXPECT_EQ(weights->log_weights[0], -std::numeric_limits<double>::infinity());
  EXPECT_NEAR(weights->log_weights[3], std::log(0.3), 1e-12);
}

TEST(ScoreSourceObservationModelTest, NoViewAnywhereSaysNothing) {
  Scripted source;
  source.batch = batch_of({kNoView, kNoView});
  ScoreSourceObservationModel model(source, HeadingStrategy::kCompass, {});
  const auto weights = model.weigh(localization::ParticleSet(2));
  ASSERT_TRUE(weights);
  for (const double value : weights->log_weights) EXPECT_TRUE(std::isnan(value));
  for (const double value : weights->headings_rad) EXPECT_TRUE(std::isnan(value));
  EXPECT_EQ(model.last_scores().without_view, 2U);
}

TEST(ScoreSourceObservationModelTest, CompassAsksForAllHeadingsAndReportsTheBest) {
  Scripted source;
  source.batch = batch_of({500, kNoView});
  ScoreSourceObservationModel model(source, HeadingStrategy::kCompass, {});
  const auto weights = model.weigh(localization::ParticleSet(2));
  ASSERT_TRUE(weights);
  EXPECT_EQ(source.asked.mode, HeadingMode::kCompass);
  EXPECT_NEAR(weights->headings_rad[0], rad_from_deg(90.0), 1e-12);
  EXPECT_TRUE(std::isnan(weights->headings_rad[1]));
}

TEST(ScoreSourceObservationModelTest, CombinedHeadingAsksForWholeCurvesAndStaysNearOdometry) {
  Scripted source;
  source.batch = batch_of({900});
  source.batch.curve.assign(PoseGrid::kHeadings, 100);
  source.batch.curve[30] = 800;  // near what odometry says
  source.batch.curve[90] = 900;  // alike, and on the other side
  ScoreSourceObservationModel model(source, HeadingStrategy::kCombined, {.power = 2.0});
  const auto weights = model.weigh(particles_at({{0.0, 0.0, rad_from_deg(86.0)}}));
  ASSERT_TRUE(weights) << weights.error().message;
  EXPECT_TRUE(source.asked.whole_curve);
  EXPECT_NEAR(weights->headings_rad[0], rad_from_deg(90.0), rad_from_deg(1.5));
}

TEST(ScoreSourceObservationModelTest, CombinedHeadingOfAParticleThatKnowsNoneIsTheCompass) {
  Scripted source;
  source.batch = batch_of({900});
  source.batch.curve.assign(PoseGrid::kHeadings, 100);
  source.batch.curve[30] = 800;
  source.batch.curve[90] = 900;
  ScoreSourceObservationModel model(source, HeadingStrategy::kCombined, {.power = 2.0});
  localization::ParticleSet particles = particles_at({{0.0, 0.0, rad_from_deg(86.0)}});
  particles[0].yaw_known = false;
  const auto weights = model.weigh(particles);
  ASSERT_TRUE(weights);
  EXPECT_NEAR(weights->headings_rad[0], rad_from_deg(-90.0), rad_from_deg(1.5));
}

TEST(ScoreSourceObservationModelTest, AsksForEachParticlesOwnDistortionOnlyIfThereIsOne) {
  Scripted source;
  source.batch = batch_of({500, 500});
  ScoreSourceObservationModel model(source, HeadingStrategy::kOdometry, {});
  localization::ParticleSet particles(2);
  ASSERT_TRUE(model.weigh(particles));
  EXPECT_TRUE(source.asked.affines.empty());
  particles[1].affine = {.a = 1.2};
  ASSERT_TRUE(model.weigh(particles));
  EXPECT_EQ(source.asked.affines, (std::vector<MapAffine>{{}, {.a = 1.2}}));
}

TEST(ScoreSourceObservationModelTest, ScoresWhereTheEyeStands) {
  Scripted source;
  source.batch = batch_of({500});
  ScoreSourceObservationModel model(source, HeadingStrategy::kOdometry, {});
  Observation observation;
  observation.base_from_eye = {0.2, 0.1, 0.0};
  ASSERT_TRUE(model.set_observation(observation));
  ASSERT_TRUE(model.weigh(particles_at({{1.0, 2.0, kPi / 2.0}})));
  EXPECT_NEAR(source.asked.poses[0].x_m, 0.9, 1e-12);
  EXPECT_NEAR(source.asked.poses[0].y_m, 2.2, 1e-12);
  EXPECT_NEAR(source.asked.poses[0].yaw_rad, kPi / 2.0, 1e-12);
}

TEST(ScoreSourceObservationModelTest, AnswerOfAnotherSizeIsAnError) {
  Scripted source;
  source.batch = batch_of({500});
  ScoreSourceObservationModel model(source, HeadingStrategy::kOdometry, {});
  EXPECT_EQ(model.weigh(localization::ParticleSet(2)).error().code, ErrorCode::kInternal);
  source.batch.observed_pixels = 0;
  EXPECT_FALSE(model.weigh(localization::ParticleSet(1)));
}

}  // namespace
}  // namespace semview::observation
