// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/score_explanation.hpp"

#include <array>
#include <cstdlib>

#include <gtest/gtest.h>

#include "reference/literal_similarity.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "similarity/random_scene.hpp"

namespace semview::similarity {
namespace {

std::int64_t total(const std::vector<ClassContribution>& contributions) {
  std::int64_t sum = 0;
  for (const ClassContribution& contribution : contributions) sum += contribution.sum;
  return sum;
}

std::int64_t pixels(const std::vector<ClassContribution>& contributions) {
  std::int64_t count = 0;
  for (const ClassContribution& contribution : contributions) count += contribution.pixels;
  return count;
}

TEST(ScoreExplanationTest, PictureAndTablesAddUpToTheScoreToTheLastUnit) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Rng rng(seed, "explanation");
    PanoramaCamera camera;
    camera.columns = 120 * (1 + static_cast<int>(rng.below(3)));
    camera.rows = 1 + static_cast<int>(rng.below(15));
    const ClassTable observed = numbered_classes("seen", 1 + static_cast<int>(rng.below(9)));
    const ClassTable map = numbered_classes("map", 1 + static_cast<int>(rng.below(9)));
    const int first = static_cast<int>(rng.below(60));
    const Observation observation =
        random_observation(rng, camera, observed, first, first + 50, 0.3);
    const WeightMatrix weights =
        random_weights(rng, observed, map, 1 + static_cast<int>(rng.below(4)), 1.0);
    const ColumnView view = ColumnView::from_labels(random_labels(rng, camera, map.size()));
    const int heading = static_cast<int>(rng.below(PoseGrid::kHeadings));

    const auto explained = explain_score(observation, weights, map, camera, view, heading);
    ASSERT_TRUE(explained) << explained.error().message;
    const auto prepared = PreparedObservation::build(observation, weights, map, camera).value();
    EXPECT_EQ(explained->sum, prepared.sum(view, heading)) << "the scorer, run by run";
    EXPECT_EQ(explained->sum,
              reference::literal_sum(observation, weights, map, camera, view, heading));
    EXPECT_EQ(explained->weight_scale, prepared.weight_scale());
    EXPECT_EQ(explained->observed_pixels, prepared.observed_pixels());
    EXPECT_EQ(explained->similarity(explained->sum), prepared.similarity(explained->sum));

    std::int64_t picture = 0;
    for (const std::int32_t part : explained->contributions.pixels()) picture += part;
    EXPECT_EQ(picture, explained->sum);
    EXPECT_EQ(total(explained->pairs), explained->sum);
    EXPECT_EQ(total(explained->observed), explained->sum);
    EXPECT_EQ(pixels(explained->pairs), explained->observed_pixels);
    EXPECT_EQ(pixels(explained->observed), explained->observed_pixels);
    EXPECT_EQ(explained->view, view.to_labels(heading));
  }
}

TEST(ScoreExplanationTest, SaysWhichClassesRaisedAndLoweredIt) {
  PanoramaCamera camera;
  camera.columns = 120;
  camera.rows = 2;
  const ClassTable observed({"wall", "door", "person"});
  const ClassTable map({"wall", "door"});
  const auto weights = WeightMatrix::build({"wall", "door", "person"},
                                           {"none", "wall", "door"},
                                           {{-90.0, 90.0, {0, 0.5, -1, 0, -0.25, 1, 0, 0, 0}}});
  ASSERT_TRUE(weights) << weights.error().message;
  LabelImage seen(2, 120, kUnknown);
  seen.at(0, 0) = 1;  // wall on wall
  seen.at(0, 1) = 1;  // wall on door
  seen.at(0, 2) = 1;  // wall on door
  seen.at(1, 0) = 2;  // door on wall
  seen.at(1, 5) = 3;  // a person on nothing
  LabelImage drawn(2, 120, 1);
  drawn.at(0, 1) = drawn.at(0, 2) = 2;
  drawn.at(1, 5) = kNoHit;
  const auto explained =
      explain_score({observed, seen}, *weights, map, camera, ColumnView::from_labels(drawn), 0);
  ASSERT_TRUE(explained) << explained.error().message;
  const std::int32_t unit = explained->weight_scale;
  EXPECT_EQ(unit, 400);
  const std::vector<ClassContribution> pairs{
      {1, 2, 2, -2 * unit}, {1, 1, 1, unit / 2}, {2, 1, 1, -unit / 4}, {3, 0, 1, 0}};
  EXPECT_EQ(explained->pairs, pairs);
  ASSERT_EQ(explained->observed.size(), 3U);
  EXPECT_EQ(explained->observed[0].pixels, 3);
  EXPECT_EQ(explained->observed[0].sum, -3 * unit / 2);
  EXPECT_EQ(explained->contributions.at(0, 1), -unit);
  EXPECT_EQ(explained->contributions.at(1, 7), 0);
  EXPECT_DOUBLE_EQ(explained->similarity(explained->sum), -1.75 / 5.0);
}

TEST(ScoreExplanationTest, RefusesAViewOfAnotherShape) {
  PanoramaCamera camera;
  camera.columns = 120;
  camera.rows = 2;
  const ClassTable classes({"wall"});
  const Observation observation{classes, LabelImage(2, 120, 1)};
  const auto explained = explain_score(observation,
                                       WeightMatrix::identity(classes),
                                       classes,
                                       camera,
                                       ColumnView::from_labels(LabelImage(3, 120, 1)),
                                       0);
  ASSERT_FALSE(explained);
  EXPECT_EQ(explained.error().code, ErrorCode::kInternal);
}

}  // namespace
}  // namespace semview::similarity
