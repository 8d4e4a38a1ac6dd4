// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "reference/literal_similarity.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "similarity/random_scene.hpp"
#include "support/only_target.hpp"

namespace semview::similarity {
namespace {

TEST(PreparedObservationPropertyTest, SumsEqualTheLiteralPixelFormAtAllHeadings) {
  const bool held = rc::check([] {
    Rng rng(*rc::gen::arbitrary<std::uint64_t>(), "similarity");
    PanoramaCamera camera;
    camera.columns = 120 * *rc::gen::inRange(1, 4);
    camera.rows = *rc::gen::inRange(1, 16);
    const ClassTable observed = numbered_classes("seen", *rc::gen::inRange(1, 12));
    const ClassTable map = numbered_classes("map", *rc::gen::inRange(1, 12));
    const int first = *rc::gen::inRange(0, camera.columns);
    const int last = *rc::gen::inRange(first + 1, camera.columns + 1);
    const double unknown = *rc::gen::element(0.0, 0.3, 0.95);
    const double largest = *rc::gen::element(0.3, 1.0, 7.5, 900.0);
    const Observation observation = random_observation(rng, camera, observed, first, last, unknown);
    const WeightMatrix weights =
        random_weights(rng, observed, map, *rc::gen::inRange(1, 5), largest);
    const ColumnView view = ColumnView::from_labels(random_labels(rng, camera, map.size()));

    const auto prepared = PreparedObservation::build(observation, weights, map, camera);
    RC_ASSERT(prepared.has_value());
    RC_ASSERT(prepared->weight_scale() == reference::literal_scale(weights, camera.rows));
    RC_ASSERT(prepared->observed_pixels() == reference::literal_observed_pixels(observation));
    RC_ASSERT(prepared->fits(view));
    for (const int k : {0, 1, 59, 119, *rc::gen::inRange(0, PoseGrid::kHeadings)}) {
      RC_ASSERT(prepared->sum(view, k) ==
                reference::literal_sum(observation, weights, map, camera, view, k));
    }
  });
  ASSERT_TRUE(held);
}

TEST(PreparedObservationPropertyTest, EveryTargetSweepsToTheSumOfEachHeading) {
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  ASSERT_FALSE(targets.empty());
  const bool held = rc::check([&targets] {
    Rng rng(*rc::gen::arbitrary<std::uint64_t>(), "sweep");
    PanoramaCamera camera;
    // 720 columns and more do not fit one stretch of 16-bit sums.
    camera.columns = 120 * *rc::gen::element(1, 2, 3, 6, 11);
    camera.rows = *rc::gen::inRange(1, 16);
    const ClassTable observed = numbered_classes("seen", *rc::gen::inRange(1, 5));
    const ClassTable map = numbered_classes("map", *rc::gen::inRange(1, 9));
    const int first = *rc::gen::inRange(0, camera.columns);
    const int last = *rc::gen::inRange(first + 1, camera.columns + 1);
    const double unknown = *rc::gen::element(0.0, 0.3, 0.95);
    const Observation observation = random_observation(rng, camera, observed, first, last, unknown);
    const WeightMatrix weights =
        random_weights(rng, observed, map, *rc::gen::inRange(1, 5), *rc::gen::element(0.3, 7.5));
    const ColumnView view = ColumnView::from_labels(random_labels(rng, camera, map.size()));
    const auto prepared = PreparedObservation::build(observation, weights, map, camera);
    RC_ASSERT(prepared.has_value());
    std::array<std::int32_t, PoseGrid::kHeadings> singly{};
    for (std::size_t k = 0; k < singly.size(); ++k) {
      singly[k] = prepared->sum(view, static_cast<int>(k));
    }
    for (const std::int64_t target : targets) {
      const OnlyTarget only(target);
      std::array<std::int32_t, PoseGrid::kHeadings> sums{};
      prepared->all_headings(view, sums);
      RC_ASSERT(sums == singly);
    }
  });
  ASSERT_TRUE(held);
}

TEST(PreparedObservationPropertyTest, AListOfHeadingsHasTheSumOfEach) {
  const bool held = rc::check([] {
    Rng rng(*rc::gen::arbitrary<std::uint64_t>(), "list");
    PanoramaCamera camera;
    camera.columns = 240;
    camera.rows = 9;
    const ClassTable classes = numbered_classes("class", 4);
    const int last = *rc::gen::inRange(1, camera.columns + 1);
    const Observation observation = random_observation(rng, camera, classes, 0, last, 0.2);
    const auto prepared = PreparedObservation::build(
        observation, random_weights(rng, classes, classes, 1, 1.0), classes, camera);
    RC_ASSERT(prepared.has_value());
    const ColumnView view = ColumnView::from_labels(random_labels(rng, camera, classes.size()));
    const auto headings =
        *rc::gen::container<std::vector<std::uint8_t>>(rc::gen::inRange<std::uint8_t>(0, 120));
    std::vector<std::int32_t> sums(headings.size());
    prepared->some_headings(view, headings, sums);
    for (std::size_t i = 0; i < headings.size(); ++i) {
      RC_ASSERT(sums[i] == prepared->sum(view, headings[i]));
    }
  });
  ASSERT_TRUE(held);
}

TEST(PreparedObservationPropertyTest, SimilarityIsEquationOneUpToTheRoundingOfWeights) {
  const bool held = rc::check([] {
    Rng rng(*rc::gen::arbitrary<std::uint64_t>(), "similarity");
    PanoramaCamera camera;
    camera.columns = 120;
    camera.rows = 30;
    const ClassTable observed = numbered_classes("seen", 5);
    const ClassTable map = numbered_classes("map", 4);
    const Observation observation = random_observation(rng, camera, observed, 20, 90, 0.2);
    const WeightMatrix weights = random_weights(rng, observed, map, 1, 1.0);
    const ColumnView view = ColumnView::from_labels(random_labels(rng, camera, map.size()));
    const auto prepared = PreparedObservation::build(observation, weights, map, camera);
    RC_ASSERT(prepared.has_value());
    const int heading = *rc::gen::inRange(0, PoseGrid::kHeadings);
    const double exact =
        reference::literal_similarity(observation, weights, map, camera, view.to_labels(heading));
    const double ours = prepared->similarity(prepared->sum(view, heading));
    // Each weight is off by half a unit of the scale at most.
    RC_ASSERT(std::abs(ours - exact) <= 0.5 / prepared->weight_scale() + 1e-12);
  });
  ASSERT_TRUE(held);
}

}  // namespace
}  // namespace semview::similarity
