// SPDX-License-Identifier: Apache-2.0
#include "semview/view/column_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace semview {
namespace {

LabelImage two_columns() {
  LabelImage labels(4, 2);
  labels.at(0, 0) = labels.at(1, 0) = 3;
  labels.at(2, 0) = 1;
  labels.at(3, 0) = 2;
  labels.at(0, 1) = labels.at(1, 1) = labels.at(2, 1) = labels.at(3, 1) = 7;
  return labels;
}

TEST(ColumnViewTest, AColumnIsItsRunsFromTheTop) {
  const ColumnView view = ColumnView::from_labels(two_columns());
  EXPECT_EQ(view.columns(), 2);
  EXPECT_EQ(view.rows(), 4);
  ASSERT_EQ(view.column(0).size(), 3U);
  EXPECT_EQ(view.column(0)[0], (semview::Run{2, 3}));
  EXPECT_EQ(view.column(0)[1], (semview::Run{3, 1}));
  EXPECT_EQ(view.column(0)[2], (semview::Run{4, 2}));
  ASSERT_EQ(view.column(1).size(), 1U);
  EXPECT_EQ(view.column(1)[0], (semview::Run{4, 7}));
}

TEST(ColumnViewTest, RunsGiveThePixelsBack) {
  EXPECT_EQ(ColumnView::from_labels(two_columns()).to_labels(), two_columns());
}

TEST(ColumnViewTest, AHeadingTurnsTheColumns) {
  LabelImage labels(1, 120);
  for (int c = 0; c < 120; ++c) labels.at(0, c) = static_cast<ClassId>(c + 1);
  const ColumnView view = ColumnView::from_labels(labels);
  // Turning counter-clockwise brings what was left of the middle into the middle.
  EXPECT_EQ(view.to_labels(1).at(0, 60), labels.at(0, 59));
  EXPECT_EQ(view.to_labels(119).at(0, 60), labels.at(0, 61));
}

/// What a 1.2 m high eye sees of a wall 3 m ahead that ends in the sky, and of the floor before it.
class SeenWallTest : public ::testing::Test {
 protected:
  static constexpr double kWall_m = 3.0;
  static constexpr double kEye_m = 1.2;

  static double true_range_m(double elevation_rad) {
    if (elevation_rad > kPi / 8.0) return std::numeric_limits<double>::infinity();
    const double to_wall = kWall_m / std::cos(elevation_rad);
    return elevation_rad < 0.0 ? std::min(to_wall, -kEye_m / std::sin(elevation_rad)) : to_wall;
  }

  PanoramaCamera camera_{120, 16, -kPi / 4.0, kPi / 4.0};
  std::vector<std::uint32_t> first_run_;
  std::vector<semview::Run> runs_;
  std::vector<RunPlane> planes_;

  void SetUp() override {
    for (int c = 0; c <= camera_.columns; ++c) first_run_.push_back(static_cast<unsigned>(3 * c));
    for (int c = 0; c < camera_.columns; ++c) {
      runs_.insert(runs_.end(), {{4, kNoHit}, {12, 2}, {16, 1}});
      planes_.insert(planes_.end(),
                     {{0.0F, 0.0F},
                      {static_cast<float>(1.0 / kWall_m), 0.0F},
                      {0.0F, static_cast<float>(-1.0 / kEye_m)}});
    }
  }
};

TEST_F(SeenWallTest, PlanesGiveTheRangesBack) {
  const Result<ColumnView> view = ColumnView::from_runs(16, first_run_, runs_, planes_);
  ASSERT_TRUE(view) << view.error().message;
  ASSERT_TRUE(view->has_ranges());
  const RangeImage ranges = view->to_ranges(camera_, 7);
  for (int r = 0; r < camera_.rows; ++r) {
    const double truth = true_range_m(camera_.elevation_rad(r));
    for (int c = 0; c < camera_.columns; ++c) {
      if (std::isinf(truth)) {
        EXPECT_EQ(ranges.at(r, c), truth);
      } else {
        EXPECT_NEAR(ranges.at(r, c), truth, 1e-6) << "row " << r;
      }
    }
  }
}

TEST_F(SeenWallTest, ArrangedColumnsKeepTheirPlanes) {
  planes_[4].a_per_m *= 2.0F;  // column 1 is nearer
  const ColumnView view = *ColumnView::from_runs(16, first_run_, runs_, planes_);
  const ColumnView two = view.arranged(std::vector<std::uint32_t>{1, 0});
  ASSERT_EQ(two.planes().size(), 6U);
  EXPECT_EQ(two.planes()[1], planes_[4]);
  EXPECT_EQ(two.planes()[4], planes_[1]);
}

TEST_F(SeenWallTest, OneClassOnTwoSurfacesIsTwoRuns) {
  for (semview::Run& run : runs_) run.label = run.label == 1 ? 2 : run.label;
  EXPECT_TRUE(ColumnView::from_runs(16, first_run_, runs_, planes_));
  EXPECT_FALSE(ColumnView::from_runs(16, first_run_, runs_));
}

TEST_F(SeenWallTest, PlanesThatFitNoRunAreDataLoss) {
  const auto code_with = [&](std::vector<RunPlane> planes) {
    const Result<ColumnView> view = ColumnView::from_runs(16, first_run_, runs_, std::move(planes));
    return view ? ErrorCode::kUnknown : view.error().code;
  };
  std::vector<RunPlane> planes = planes_;
  planes.pop_back();
  EXPECT_EQ(code_with(planes), ErrorCode::kDataLoss) << "one too few";
  planes = planes_;
  planes[1].b_per_m = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(code_with(planes), ErrorCode::kDataLoss) << "not a number";
  planes = planes_;
  planes[1] = {};
  EXPECT_EQ(code_with(planes), ErrorCode::kDataLoss) << "a wall without a plane";
  planes = planes_;
  planes[0] = {1.0F, 0.0F};
  EXPECT_EQ(code_with(planes), ErrorCode::kDataLoss) << "a plane in the sky";
}

struct Broken {
  const char* name;
  std::vector<std::uint32_t> first_run;
  std::vector<semview::Run> runs;
};

class BrokenRunsTest : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenRunsTest, AreDataLoss) {
  const Result<ColumnView> view = ColumnView::from_runs(4, GetParam().first_run, GetParam().runs);
  ASSERT_FALSE(view);
  EXPECT_EQ(view.error().code, ErrorCode::kDataLoss);
}

INSTANTIATE_TEST_SUITE_P(ColumnView,
                         BrokenRunsTest,
                         ::testing::Values(Broken{"NoOffsets", {}, {}},
                                           Broken{"OffsetsBeginLate", {1, 1}, {{4, 1}}},
                                           Broken{"OffsetsEndEarly", {0, 1}, {{4, 1}, {4, 2}}},
                                           Broken{"OffsetsPastTheRuns", {0, 9, 1}, {{4, 1}}},
                                           Broken{"ColumnWithoutRuns", {0, 1, 1}, {{4, 1}}},
                                           Broken{"EmptyRun", {0, 2}, {{0, 1}, {4, 2}}},
                                           Broken{"RunsGoBack", {0, 3}, {{2, 1}, {1, 2}, {4, 1}}},
                                           Broken{"EqualNeighbours", {0, 2}, {{2, 1}, {4, 1}}},
                                           Broken{"TooShort", {0, 1}, {{3, 1}}},
                                           Broken{"TooLong", {0, 1}, {{5, 1}}}),
                         [](const auto& broken) { return broken.param.name; });

}  // namespace
}  // namespace semview
