// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/dense_posterior.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "semview/observation/cell_posterior.hpp"

namespace semview::observation {
namespace {

constexpr int kHeadings = PoseGrid::kHeadings;
constexpr double kScale = 1000.0;

/// Hills of similarity at known places, on a floor of 30 x 20 cells; (5, 5) has no view.
class HillySource final : public ScoreSource {
 public:
  struct Hill {
    GridKey top;
    double height = 0.0;
  };
  std::vector<Hill> hills;
  int calls = 0;

  const ViewProfile& profile() const override { return profile_; }
  Status set_observation(const Observation&) override { return {}; }
  Result<ScoreBatch> score(const ScoreRequest& request) override {
    ++calls;
    ScoreBatch batch;
    batch.weight_scale = 10;
    batch.observed_pixels = 100;
    batch.origins.memory = request.poses.size();
    for (const Pose2& pose : request.poses) {
      const CellIndex cell = *PoseGrid::cell(pose.x_m, pose.y_m);
      for (int k = 0; k < kHeadings; ++k) batch.curve.push_back(sum({cell, k}));
    }
    return batch;
  }

  std::int32_t sum(const GridKey& key) const {
    if (key.cell == CellIndex{5, 5}) return kNoView;
    double highest = -0.1;
    for (const Hill& hill : hills) {
      const int turn = std::abs(key.heading - hill.top.heading);
      const double apart = std::hypot(key.cell.ix - hill.top.cell.ix,
                                      key.cell.iy - hill.top.cell.iy,
                                      0.5 * std::min(turn, kHeadings - turn));
      highest = std::max(highest, hill.height - 0.06 * apart);
    }
    return static_cast<std::int32_t>(std::lround(kScale * highest));
  }

 private:
  ViewProfile profile_;
};

std::vector<CellIndex> floor_cells() {
  std::vector<CellIndex> cells;
  for (int iy = 0; iy < 20; ++iy) {
    for (int ix = 0; ix < 30; ++ix) cells.push_back({ix, iy});
  }
  return cells;
}

HillySource two_hills() {
  HillySource source;
  source.hills = {{{{6, 10}, 119}, 0.8}, {{{22, 8}, 59}, 0.8}};
  return source;
}

DensePosterior posterior_of(HillySource& source, const Pose2& base_from_eye = {}) {
  return DensePosterior::compute(source, {}, floor_cells(), base_from_eye).value();
}

TEST(DensePosteriorTest, GivesEveryHypothesisTheWeightOfTheFilterOverTheSumOfAll) {
  HillySource source = two_hills();
  for (const WeightTransform transform : {WeightTransform::kPower, WeightTransform::kExponential}) {
    const SimilarityWeightingConfig config{.transform = transform};
    const auto posterior = DensePosterior::compute(source, config, floor_cells(), {});
    ASSERT_TRUE(posterior);
    const auto weight = [&](const CellIndex& cell, int heading) {
      const std::int32_t sum = source.sum({cell, heading});
      return sum == kNoView ? 0.0 : std::exp(log_weight(config, sum / kScale));
    };
    double total = 0.0;
    for (const CellIndex& cell : posterior->cells()) {
      for (int k = 0; k < kHeadings; ++k) total += weight(cell, k);
    }
    double all = 0.0;
    for (std::size_t i = 0; i < posterior->cells().size(); ++i) {
      for (int k = 0; k < kHeadings; ++k) {
        const double expected = weight(posterior->cells()[i], k) / total;
        ASSERT_NEAR(posterior->probability(i, k), expected, 1e-12 + 1e-9 * expected);
        all += posterior->probability(i, k);
      }
    }
    EXPECT_NEAR(all, 1.0, 1e-9);
    EXPECT_EQ(posterior->scores().without_view, 1U);
    EXPECT_EQ(posterior->scores().best_similarity, 0.8);
    EXPECT_EQ(posterior->scores().origins.memory, 600U);
  }
}

TEST(DensePosteriorTest, CellProbabilitiesAreItsSumsOverAllHeadings) {
  HillySource source = two_hills();
  for (const WeightTransform transform : {WeightTransform::kPower, WeightTransform::kExponential}) {
    // Of the low power every cell has its part; the high one leaves the range of doubles.
    for (const double sharpness : {2.0, 40.0, 4000.0}) {
      const SimilarityWeightingConfig config{transform, sharpness, sharpness};
      const auto posterior = DensePosterior::compute(source, config, floor_cells(), {});
      ASSERT_TRUE(posterior);
      std::vector<double> log_weights;
      for (const CellIndex& cell : posterior->cells()) {
        std::vector<double> similarities;
        for (int k = 0; k < kHeadings; ++k) {
          const std::int32_t sum = source.sum({cell, k});
          if (sum != kNoView) similarities.push_back(sum / kScale);
        }
        log_weights.push_back(similarities.empty() ? std::nan("")
                                                   : cell_log_weight(config, similarities));
      }
      const auto probabilities = cell_probabilities(log_weights);
      ASSERT_TRUE(probabilities);
      double all = 0.0;
      for (std::size_t i = 0; i < posterior->cells().size(); ++i) {
        if (std::isnan(log_weights[i])) {
          EXPECT_TRUE(std::isnan((*probabilities)[i]));
          continue;
        }
        double expected = 0.0;
        for (int k = 0; k < kHeadings; ++k) expected += posterior->probability(i, k);
        ASSERT_NEAR((*probabilities)[i], expected, 1e-6 * expected + 1e-30);
        all += static_cast<double>((*probabilities)[i]);
      }
      EXPECT_NEAR(all, 1.0, 1e-6);
    }
  }
}

TEST(DensePosteriorTest, WhereNothingIsPossibleThereAreNoCellProbabilities) {
  const std::vector<double> similarities(kHeadings, -0.2);
  const std::vector<double> log_weights{std::nan(""), cell_log_weight({}, similarities)};
  EXPECT_EQ(cell_probabilities(log_weights).error().code, ErrorCode::kFailedPrecondition);
}

TEST(DensePosteriorTest, ProgressIsToldAndEndsIt) {
  HillySource source = two_hills();
  std::vector<CellIndex> cells;
  for (int i = 0; i < 3000; ++i) cells.push_back({i % 60, i / 60});
  std::vector<std::size_t> told;
  const auto tell = [&](std::size_t done, std::size_t all) {
    EXPECT_EQ(all, 3000U);
    told.push_back(done);
    return told.size() < 5;
  };
  ASSERT_TRUE(DensePosterior::compute(source, {}, cells, {}, tell));
  EXPECT_EQ(told, (std::vector<std::size_t>{1024, 2048, 3000}));
  const auto stopped = DensePosterior::compute(source, {}, cells, {}, tell);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(told.size(), 5U);
}

TEST(DensePosteriorTest, TwoPlacesThatLookAlikeAreTwoModesOfHalfTheBelief) {
  HillySource source = two_hills();
  const auto modes = posterior_of(source).modes(5);
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_EQ(modes[0].map_from_robot, PoseGrid::center(GridKey{{22, 8}, 59}));
  EXPECT_EQ(modes[1].map_from_robot, PoseGrid::center(GridKey{{6, 10}, 119}));
  for (const PosteriorMode& mode : modes) {
    EXPECT_EQ(mode.similarity, 0.8);
    EXPECT_NEAR(mode.probability, 0.5, 0.02);
  }
}

TEST(DensePosteriorTest, NeighboursOfAModeAreNoneAndFaintPlacesAreLeftOut) {
  HillySource source = two_hills();
  source.hills.push_back({{{8, 10}, 4}, 0.79});   // 0.2 m and 15° beside the first
  source.hills.push_back({{{14, 2}, 30}, 0.50});  // 0.8e-4 of the highest weight
  const DensePosterior posterior = posterior_of(source);
  EXPECT_EQ(posterior.modes(5).size(), 2U);
  EXPECT_EQ(posterior.modes(1).size(), 1U);
  // With less reach the neighbour is a place of its own.
  EXPECT_EQ(posterior.modes(5, {.radius_m = 0.1, .heading_radius_rad = 0.1}).size(), 3U);
}

TEST(DensePosteriorTest, ParticlesAreSpreadAsThePosteriorIsAndFillTheirCells) {
  HillySource source = two_hills();
  const DensePosterior posterior = posterior_of(source);
  constexpr std::size_t kCount = 20'000;
  Rng rng(3, "draw");
  const auto particles = posterior.draw(kCount, rng);
  ASSERT_EQ(particles.size(), kCount);
  std::map<std::pair<CellIndex, int>, double> share;
  double mean_offset = 0.0;
  for (const localization::Particle& particle : particles) {
    const GridKey key = PoseGrid::key(particle.map_from_robot).value();
    share[{key.cell, key.heading}] += 1.0 / kCount;
    mean_offset += (particle.map_from_robot.x_m - PoseGrid::center(key.cell).x_m) / kCount;
    EXPECT_EQ(particle.heading_rad, particle.map_from_robot.yaw_rad);
    EXPECT_TRUE(particle.yaw_known);
    EXPECT_EQ(particle.weight, 1.0 / kCount);
  }
  EXPECT_LT(std::abs(mean_offset), 0.001);  // sigma of the mean: 0.0002
  // Five standard deviations of independent draws and two particles; systematic ones do better.
  for (std::size_t i = 0; i < posterior.cells().size(); ++i) {
    for (int k = 0; k < kHeadings; ++k) {
      const double p = posterior.probability(i, k);
      const auto found = share.find({posterior.cells()[i], k});
      const double drawn = found == share.end() ? 0.0 : found->second;
      ASSERT_NEAR(drawn, p, 5.0 * std::sqrt(p / kCount) + 2.0 / kCount);
    }
  }
  Rng again(3, "draw");
  EXPECT_EQ(posterior.draw(kCount, again), particles);
}

TEST(DensePosteriorTest, TheRobotStandsWhereItsEyeSeesThat) {
  HillySource source = two_hills();
  const Pose2 base_from_eye{0.25, -0.1, 0.0};
  const DensePosterior posterior = posterior_of(source, base_from_eye);
  const Pose2 eye = posterior.modes(1)[0].map_from_robot * base_from_eye;
  EXPECT_NEAR(distance_m(eye, PoseGrid::center(GridKey{{22, 8}, 59})), 0.0, 1e-12);
  Rng rng(1);
  for (const localization::Particle& particle : posterior.draw(50, rng)) {
    EXPECT_TRUE(posterior.probability(
                    static_cast<std::size_t>(
                        std::ranges::lower_bound(
                            posterior.cells(),
                            PoseGrid::key(particle.map_from_robot * base_from_eye)->cell) -
                        posterior.cells().begin()),
                    PoseGrid::key(particle.map_from_robot * base_from_eye)->heading) > 0.0);
  }
}

TEST(DensePosteriorTest, OrderAndRepetitionOfCellsChangeNothing) {
  HillySource source = two_hills();
  const DensePosterior posterior = posterior_of(source);
  std::vector<CellIndex> cells = floor_cells();
  std::ranges::reverse(cells);
  cells.push_back(cells[7]);
  const auto other = DensePosterior::compute(source, {}, cells, {});
  ASSERT_TRUE(other);
  Rng one(1);
  Rng two(1);
  EXPECT_EQ(posterior.draw(100, one), other->draw(100, two));
}

TEST(DensePosteriorTest, ManyCellsAreAskedForAFewAtATime) {
  HillySource source = two_hills();
  std::vector<CellIndex> cells;
  for (int ix = 0; ix < 2500; ++ix) cells.push_back({ix, 10});
  ASSERT_TRUE(DensePosterior::compute(source, {}, cells, {}));
  EXPECT_EQ(source.calls, 3);
}

TEST(DensePosteriorTest, WithoutAnySimilarityThereIsNoBelief) {
  HillySource source;
  const DensePosterior posterior = posterior_of(source);
  EXPECT_FALSE(posterior.informative());
  EXPECT_TRUE(posterior.modes(5).empty());
  EXPECT_EQ(posterior.probability(3, 3), 0.0);
}

TEST(DensePosteriorTest, RefusesNoCellsAndTooMany) {
  HillySource source;
  EXPECT_EQ(DensePosterior::compute(source, {}, {}, {}).error().code, ErrorCode::kInvalidArgument);
  std::vector<CellIndex> cells;
  for (std::size_t i = 0; i <= kMaxPosteriorCells; ++i) {
    cells.push_back({static_cast<std::int32_t>(i), 0});
  }
  EXPECT_EQ(DensePosterior::compute(source, {}, cells, {}).error().code,
            ErrorCode::kResourceExhausted);
  EXPECT_EQ(source.calls, 0);
}

}  // namespace
}  // namespace semview::observation
