// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/prepared_observation.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference/literal_similarity.hpp"
#include "semview/view/view_profile.hpp"
#include "similarity/random_scene.hpp"
#include "support/only_target.hpp"

namespace semview::similarity {
namespace {

using testing::Each;
using testing::HasSubstr;

const ClassTable kWallFloor({"wall", "floor"});

WeightMatrix weights_of(double weight) {
  WeightMatrix::Band band;
  band.weights.assign(6, weight);
  return WeightMatrix::build({"wall", "floor"}, {"wall", "floor", "none"}, {band}).value();
}

Observation all_of(ClassId label, const PanoramaCamera& camera) {
  return {kWallFloor, LabelImage(camera.rows, camera.columns, label), 0.0};
}

/// The sums at all headings, which every target of this machine agrees upon.
std::array<std::int32_t, PoseGrid::kHeadings> curve(const PreparedObservation& prepared,
                                                    const ColumnView& view) {
  std::array<std::int32_t, PoseGrid::kHeadings> sums{};
  prepared.all_headings(view, sums);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    const OnlyTarget only(target);
    std::array<std::int32_t, PoseGrid::kHeadings> others{};
    prepared.all_headings(view, others);
    EXPECT_EQ(others, sums) << hwy::TargetName(target);
  }
  return sums;
}

TEST(PreparedObservationTest, ThePictureOfItselfHasSimilarityOneWithTheIdentity) {
  const PanoramaCamera camera;
  Rng rng(1);
  LabelImage labels = random_labels(rng, camera, 2);
  for (ClassId& label : labels.pixels()) label = std::max<ClassId>(label, 1);
  const auto prepared = PreparedObservation::build(
      {kWallFloor, labels, 0.0}, WeightMatrix::identity(kWallFloor), kWallFloor, camera);
  ASSERT_TRUE(prepared);
  EXPECT_EQ(prepared->weight_scale(), 364);
  const auto sums = curve(*prepared, ColumnView::from_labels(labels));
  EXPECT_EQ(prepared->similarity(sums[0]), 1.0);
  EXPECT_EQ(std::ranges::max_element(sums) - sums.begin(), 0);
}

TEST(PreparedObservationTest, ATurnedRobotFindsItsHeading) {
  const PanoramaCamera camera;
  Rng rng(2);
  LabelImage labels = random_labels(rng, camera, 2);
  for (ClassId& label : labels.pixels()) label = std::max<ClassId>(label, 1);
  const ColumnView view = ColumnView::from_labels(labels);
  for (const int heading : {0, 1, 40, 119}) {
    const Observation turned{kWallFloor, view.to_labels(heading), 0.0};
    const auto prepared =
        PreparedObservation::build(turned, WeightMatrix::identity(kWallFloor), kWallFloor, camera);
    ASSERT_TRUE(prepared);
    const auto sums = curve(*prepared, view);
    EXPECT_EQ(std::ranges::max_element(sums) - sums.begin(), heading);
    EXPECT_EQ(prepared->similarity(sums[static_cast<std::size_t>(heading)]), 1.0);
  }
}

TEST(PreparedObservationTest, TheLargestSumsOfTheLargestPanoramaAreExact) {
  // A weight that rounds up: scale 63 would make 32 of 31.5, and 1024 rows of it 32768.
  PanoramaCamera camera;
  camera.columns = kMaxPanoramaColumns;
  camera.rows = kMaxPanoramaRows;
  for (const double weight : {1.0, -1.0, 0.5, -0.5, 31.0}) {
    const auto prepared =
        PreparedObservation::build(all_of(1, camera), weights_of(weight), kWallFloor, camera);
    ASSERT_TRUE(prepared);
    const auto unit = static_cast<std::int32_t>(std::lround(weight * prepared->weight_scale()));
    EXPECT_LE(std::abs(unit) * camera.rows, 32767);
    const ColumnView view =
        ColumnView::from_labels(LabelImage(camera.rows, camera.columns, ClassId{2}));
    EXPECT_THAT(curve(*prepared, view), Each(unit * camera.rows * camera.columns));
    EXPECT_EQ(prepared->sum(view, 77), unit * camera.rows * camera.columns);
  }
}

TEST(PreparedObservationTest, SumsThatLeaveSixteenBitsOnTheWayAreExact) {
  // Above the horizon a wall speaks for the wall and against the floor as much as can be, below it
  // the other way round: prefix sums come to both ends of 16 bits, and differ by more than 16 bits
  // where one run of a view ends and the next begins.
  PanoramaCamera camera;
  for (const auto& [columns, rows] : {std::pair(360, 90), std::pair(1800, 181)}) {
    camera.columns = columns;
    camera.rows = rows;
    for (const double sign : {1.0, -1.0}) {
      const std::vector<double> above{sign, -sign, sign, sign, -sign, sign};
      std::vector<double> below;
      for (const double weight : above) below.push_back(-weight);
      for (const bool banded : {false, true}) {
        const auto weights =
            banded ? WeightMatrix::build({"wall", "floor"},
                                         {"wall", "floor", "none"},
                                         {{-90.0, 0.0, below}, {0.0, 90.0, above}})
                   : WeightMatrix::build(
                         {"wall", "floor"}, {"wall", "floor", "none"}, {{-90.0, 90.0, above}});
        ASSERT_TRUE(weights);
        const auto prepared =
            PreparedObservation::build(all_of(1, camera), *weights, kWallFloor, camera);
        ASSERT_TRUE(prepared);
        for (const int edge : {0, 1, rows / 2, rows - 1, rows}) {
          LabelImage labels(rows, columns, ClassId{2});
          for (int r = 0; r < edge; ++r) std::ranges::fill(labels.row(r), ClassId{1});
          const ColumnView view = ColumnView::from_labels(labels);
          const std::int32_t expected =
              reference::literal_sum(all_of(1, camera), *weights, kWallFloor, camera, view, 0);
          EXPECT_THAT(curve(*prepared, view), Each(expected)) << rows << " rows, edge " << edge;
        }
      }
    }
  }
}

TEST(PreparedObservationTest, AnyNumberOfRowsKeepsAFullColumnWithinSixteenBits) {
  PanoramaCamera camera;
  camera.columns = 120;
  for (camera.rows = 1; camera.rows <= kMaxPanoramaRows; camera.rows += 41) {
    for (const double weight : {1.0, -1.0, 0.5, -0.51, 0.9999, 3.7}) {
      const auto prepared =
          PreparedObservation::build(all_of(1, camera), weights_of(weight), kWallFloor, camera);
      ASSERT_TRUE(prepared);
      // The upper rows are of one class and the lower of another: both table rows are full.
      LabelImage labels(camera.rows, camera.columns, ClassId{2});
      for (ClassId& label : labels.row(0)) label = kNoHit;
      const ColumnView view = ColumnView::from_labels(labels);
      EXPECT_EQ(prepared->sum(view, 3),
                reference::literal_sum(
                    all_of(1, camera), weights_of(weight), kWallFloor, camera, view, 3))
          << camera.rows << " rows, weight " << weight;
    }
  }
}

TEST(PreparedObservationTest, UnknownPixelsCountNeitherAboveNorBelow) {
  const PanoramaCamera camera;
  Observation observation = all_of(kUnknown, camera);
  observation.labels.at(10, 180) = 1;
  observation.labels.at(11, 180) = kNoHit;
  const auto prepared =
      PreparedObservation::build(observation, weights_of(1.0), kWallFloor, camera);
  ASSERT_TRUE(prepared);
  EXPECT_EQ(prepared->observed_pixels(), 1);
  const ColumnView view = ColumnView::from_labels(LabelImage(90, 360, ClassId{1}));
  EXPECT_THAT(curve(*prepared, view), Each(prepared->weight_scale()));
}

TEST(PreparedObservationTest, RefusesWhatCannotBeScored) {
  const PanoramaCamera camera;
  const auto message = [&](const Observation& observation,
                           const WeightMatrix& weights,
                           const ClassTable& map,
                           ErrorCode code) {
    const auto prepared = PreparedObservation::build(observation, weights, map, camera);
    if (prepared) return std::string("accepted");
    EXPECT_EQ(prepared.error().code, code);
    return prepared.error().message;
  };
  const WeightMatrix weights = weights_of(1.0);
  EXPECT_THAT(message(all_of(kUnknown, camera), weights, kWallFloor, ErrorCode::kInvalidArgument),
              HasSubstr("every pixel is unknown"));
  EXPECT_THAT(message(all_of(3, camera), weights, kWallFloor, ErrorCode::kInvalidArgument),
              HasSubstr("label 3 at row 0, column 0"));
  PanoramaCamera other;
  other.rows = 91;
  EXPECT_THAT(message(all_of(1, other), weights, kWallFloor, ErrorCode::kInvalidArgument),
              HasSubstr("360 x 91"));
  EXPECT_THAT(message(all_of(1, camera),
                      weights,
                      ClassTable({"wall", "sofa", "lamp"}),
                      ErrorCode::kFailedPrecondition),
              HasSubstr("no column for map class sofa, lamp"));
  EXPECT_THAT(
      message(all_of(1, camera), weights_of(400.0), kWallFloor, ErrorCode::kFailedPrecondition),
      HasSubstr("too large"));
  WeightMatrix::Band half{0.0, 90.0, std::vector<double>(6, 1.0)};
  const auto banded =
      WeightMatrix::build({"wall", "floor"}, {"wall", "floor", "none"}, {half}).value();
  EXPECT_THAT(message(all_of(1, camera), banded, kWallFloor, ErrorCode::kFailedPrecondition),
              HasSubstr("no band for elevation"));
}

TEST(PreparedObservationTest, AViewOfAnotherShapeOrMapDoesNotFit) {
  const PanoramaCamera camera;
  const auto prepared =
      PreparedObservation::build(all_of(1, camera), weights_of(1.0), kWallFloor, camera);
  ASSERT_TRUE(prepared);
  EXPECT_TRUE(prepared->fits(ColumnView::from_labels(LabelImage(90, 360, ClassId{2}))));
  EXPECT_FALSE(prepared->fits(ColumnView::from_labels(LabelImage(90, 360, ClassId{3}))));
  EXPECT_FALSE(prepared->fits(ColumnView::from_labels(LabelImage(91, 360, ClassId{1}))));
  EXPECT_FALSE(prepared->fits(ColumnView::from_labels(LabelImage(90, 480, ClassId{1}))));
  EXPECT_FALSE(prepared->fits(ColumnView()));
}

}  // namespace
}  // namespace semview::similarity
