// SPDX-License-Identifier: Apache-2.0
#include "semview/view/column_view.hpp"

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
