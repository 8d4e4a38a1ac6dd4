// SPDX-License-Identifier: Apache-2.0
#include "semview/places/column_scorer.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "semview/core/random.hpp"

namespace semview::places {
namespace {

constexpr ColumnScorerConfig kConfig{.stray_probability = 0.2, .pixels_per_column = 3.0};

const PanoramaCamera kCamera{120, 6, -0.6, 0.6};

ClassTable names() { return ClassTable({"wall", "floor"}); }

/// Two bands: the lower half of the picture counts double.
similarity::WeightMatrix weights() {
  return similarity::WeightMatrix::build({"wall", "floor"},
                                         {"wall", "floor", "none"},
                                         {{-90.0, 0.0, {2.0, -3.0, 0.0, -2.5, 2.0, 0.5}},
                                          {0.0, 90.0, {1.0, -1.5, 0.0, -1.25, 1.0, 0.25}}})
      .value();
}

LabelImage random_labels(Rng& rng, bool observed) {
  LabelImage labels(kCamera.rows, kCamera.columns);
  for (ClassId& label : labels.pixels()) {
    label = static_cast<ClassId>(rng.below(3));
    if (observed && label == kNoHit) label = kUnknown;
  }
  return labels;
}

/// The formula of the header, word by word.
double literal_score(const LabelImage& observed, const LabelImage& view, int turn) {
  const similarity::WeightMatrix matrix = weights();
  const auto column_of = [](ClassId label) -> std::size_t { return label == 0 ? 2 : label - 1U; };
  double all = 0.0;
  double pixels = 0.0;
  for (int c = 0; c < kCamera.columns; ++c) {
    double sum = 0.0;
    double count = 0.0;
    for (int r = 0; r < kCamera.rows; ++r) {
      if (observed.at(r, c) == kUnknown) continue;
      const int source = ((c - turn) % kCamera.columns + kCamera.columns) % kCamera.columns;
      const std::size_t band = kCamera.elevation_rad(r) < 0.0 ? 0 : 1;
      sum += matrix.weight(band, observed.at(r, c) - 1U, column_of(view.at(r, source)));
      count += 1.0;
    }
    if (count == 0.0) continue;
    const double s = kConfig.stray_probability;
    const double n = kConfig.pixels_per_column;
    all += count * std::log((1.0 - s) * std::exp(n * sum / count) + s) / n;
    pixels += count;
  }
  return all / pixels;
}

TEST(ColumnScorerTest, IsTheFormulaOfItsHeader) {
  Rng rng(1);
  for (int k = 0; k < 20; ++k) {
    const LabelImage observed = random_labels(rng, true);
    const LabelImage view = random_labels(rng, false);
    const auto scorer =
        ColumnScorer::build({names(), observed}, weights(), names(), kCamera, kConfig);
    ASSERT_TRUE(scorer);
    for (const int turn : {0, 1, 59, -7, 240, -121}) {
      EXPECT_NEAR(scorer->score(view, turn), literal_score(observed, view, turn), 1e-6);
    }
  }
}

TEST(ColumnScorerTest, NoColumnSaysMoreAgainstAPlaceThanThatItStrays) {
  LabelImage observed(kCamera.rows, kCamera.columns, 1);
  LabelImage view(kCamera.rows, kCamera.columns, 1);
  const auto scorer =
      ColumnScorer::build({names(), observed}, weights(), names(), kCamera, kConfig);
  const double right = scorer->score(view, 0);
  for (int r = 0; r < kCamera.rows; ++r) view.at(r, 5) = 2;
  const double least = std::log(kConfig.stray_probability) / kConfig.pixels_per_column;
  const double one_column = 1.0 / kCamera.columns;
  EXPECT_LT(scorer->score(view, 0), right);
  EXPECT_GE(scorer->score(view, 0), right * (1.0 - one_column) + least * one_column - 1e-6);
}

TEST(ColumnScorerTest, RefusesWhatCannotBeCompared) {
  const LabelImage nothing(kCamera.rows, kCamera.columns, kUnknown);
  EXPECT_FALSE(ColumnScorer::build({names(), nothing}, weights(), names(), kCamera, kConfig));
  const LabelImage small(2, 2, 1);
  EXPECT_FALSE(ColumnScorer::build({names(), small}, weights(), names(), kCamera, kConfig));
  const LabelImage wall(kCamera.rows, kCamera.columns, 1);
  const auto unnamed =
      ColumnScorer::build({ClassTable({"tree"}), wall}, weights(), names(), kCamera, kConfig);
  ASSERT_FALSE(unnamed);
  EXPECT_EQ(unnamed.error().code, ErrorCode::kFailedPrecondition);
  EXPECT_EQ(validate(ColumnScorerConfig{.stray_probability = 0.0}).error().field,
            "stray_probability");
  EXPECT_EQ(validate(ColumnScorerConfig{.pixels_per_column = 0.0}).error().field,
            "pixels_per_column");
}

}  // namespace
}  // namespace semview::places
