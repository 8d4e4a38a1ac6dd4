// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "semview/geometry/pose_grid.hpp"
#include "semview/view/column_view.hpp"
#include "support/random_view.hpp"

namespace semview {
namespace {

LabelImage any_labels(int columns) {
  LabelImage labels(*rc::gen::inRange(1, 30), columns);
  const int classes = *rc::gen::inRange(1, 5);
  const auto values = *rc::gen::container<std::vector<ClassId>>(
      labels.pixels().size(), rc::gen::cast<ClassId>(rc::gen::inRange(0, classes)));
  std::ranges::copy(values, labels.pixels().begin());
  return labels;
}

RC_GTEST_PROP(ColumnViewProperty, RunsHoldEveryPixel, ()) {
  const LabelImage labels = any_labels(*rc::gen::inRange(1, 40));
  RC_ASSERT(ColumnView::from_labels(labels).to_labels() == labels);
}

RC_GTEST_PROP(ColumnViewProperty, RunsOfAnImageAreCanonical, ()) {
  const ColumnView view = ColumnView::from_labels(any_labels(*rc::gen::inRange(1, 40)));
  const Result<ColumnView> again =
      ColumnView::from_runs(view.rows(),
                            {view.first_run().begin(), view.first_run().end()},
                            {view.runs().begin(), view.runs().end()});
  RC_ASSERT(again.has_value());
  RC_ASSERT(*again == view);
}

RC_GTEST_PROP(ColumnViewProperty, TurningByAHeadingMovesColumnsAsTheGridSays, ()) {
  const LabelImage labels = any_labels(240);
  const int heading = *rc::gen::inRange(0, PoseGrid::kHeadings);
  const LabelImage turned = ColumnView::from_labels(labels).to_labels(heading);
  for (int c = 0; c < 240; ++c) {
    const int source = ((c - heading * 2) % 240 + 240) % 240;
    for (int r = 0; r < labels.rows(); ++r) RC_ASSERT(turned.at(r, c) == labels.at(r, source));
  }
}

RC_GTEST_PROP(ColumnViewProperty, ArrangedColumnsAreThoseNamed, ()) {
  const int count = *rc::gen::inRange(1, 20);
  const LabelImage labels = any_labels(count);
  const auto columns =
      *rc::gen::container<std::vector<std::uint32_t>>(rc::gen::inRange<std::uint32_t>(0, count));
  const ColumnView view = ColumnView::from_labels(labels).arranged(columns);
  LabelImage expected(labels.rows(), static_cast<int>(columns.size()));
  for (int c = 0; c < expected.columns(); ++c) {
    const auto source = static_cast<int>(columns[static_cast<std::size_t>(c)]);
    for (int r = 0; r < labels.rows(); ++r) expected.at(r, c) = labels.at(r, source);
  }
  RC_ASSERT(view.rows() == labels.rows());
  RC_ASSERT(view.to_labels() == expected);
}

RC_GTEST_PROP(ColumnViewProperty, WithoutRangesAreTheSameLabelsInTheFewestRuns, ()) {
  const ColumnView view = testing::random_view_with_ranges(
      *rc::gen::arbitrary<std::uint64_t>(), *rc::gen::inRange(1, 40), *rc::gen::inRange(1, 30));
  RC_ASSERT(view.without_ranges() == ColumnView::from_labels(view.to_labels()));
}

}  // namespace
}  // namespace semview
