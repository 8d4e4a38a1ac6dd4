// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/pixel_scorer.hpp"

#include <gtest/gtest.h>

#include "reference/literal_similarity.hpp"
#include "semview/core/random.hpp"

namespace semview::benchmark {
namespace {

TEST(PixelScorerTest, SumsAreTheLiteralOnesAtEveryHeading) {
  Rng rng(3, "pixel scorer");
  const ClassTable classes({"floor", "wall", "door"});
  PanoramaCamera camera;
  camera.columns = 240;
  camera.rows = 12;
  LabelImage observed(camera.rows, camera.columns);
  LabelImage seen(camera.rows, camera.columns);
  for (ClassId& label : observed.pixels()) {
    label = rng.uniform() < 0.2 ? kUnknown : static_cast<ClassId>(rng.below(4));
  }
  for (ClassId& label : seen.pixels()) label = static_cast<ClassId>(rng.below(4));
  const auto weights = similarity::WeightMatrix::build(
      {"floor", "wall", "door"},
      {"floor", "wall", "door", "none"},
      {{-90.0, 90.0, {1.0, -0.7, 0.1, -0.2, -1.0, 1.0, 0.3, 0.0, 0.2, 0.4, 0.9, -0.5}}});
  ASSERT_TRUE(weights);
  const Observation observation{classes, observed, 0.0};
  const std::int32_t scale = reference::literal_scale(*weights, camera.rows);
  const HeadingSums<std::int32_t> sums = score_pixels<std::int32_t, std::int32_t>(
      observed, seen, PixelWeights<std::int32_t>(*weights, classes, classes, scale));
  const ColumnView view = ColumnView::from_labels(seen);
  for (int heading = 0; heading < PoseGrid::kHeadings; ++heading) {
    EXPECT_EQ(sums[static_cast<std::size_t>(heading)],
              reference::literal_sum(observation, *weights, classes, camera, view, heading));
  }
}

}  // namespace
}  // namespace semview::benchmark
