// SPDX-License-Identifier: Apache-2.0
#include "semview/view/column_view.hpp"

#include <utility>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/geometry/pose_grid.hpp"

namespace semview {

ColumnView ColumnView::from_labels(const LabelImage& labels) {
  ColumnView view;
  view.rows_ = labels.rows();
  view.first_run_.reserve(static_cast<std::size_t>(labels.columns()) + 1);
  for (int c = 0; c < labels.columns(); ++c) {
    view.first_run_.push_back(static_cast<std::uint32_t>(view.runs_.size()));
    for (int r = 0; r < labels.rows(); ++r) {
      const ClassId label = labels.at(r, c);
      if (r == 0 || label != view.runs_.back().label) view.runs_.push_back({0, label});
      view.runs_.back().end_row = static_cast<std::uint16_t>(r + 1);
    }
  }
  view.first_run_.push_back(static_cast<std::uint32_t>(view.runs_.size()));
  view.runs_.shrink_to_fit();
  return view;
}

Result<ColumnView> ColumnView::from_runs(int rows,
                                         std::vector<std::uint32_t> first_run,
                                         std::vector<Run> runs) {
  const auto broken = [](std::size_t column, const char* what) {
    return fail(ErrorCode::kDataLoss, fmt::format("view: column {}: {}", column, what));
  };
  if (first_run.empty() || first_run.front() != 0 || first_run.back() != runs.size()) {
    return fail(ErrorCode::kDataLoss, "view: run offsets do not cover the runs");
  }
  for (std::size_t c = 0; c + 1 < first_run.size(); ++c) {
    if (first_run[c] >= first_run[c + 1] || first_run[c + 1] > runs.size()) {
      return broken(c, "run offsets do not increase");
    }
    int start = 0;
    for (std::size_t i = first_run[c]; i < first_run[c + 1]; ++i) {
      if (runs[i].end_row <= start) return broken(c, "empty run");
      if (i > first_run[c] && runs[i].label == runs[i - 1].label) {
        return broken(c, "neighbouring runs of one class");
      }
      start = runs[i].end_row;
    }
    if (start != rows) return broken(c, "the last run does not end at the last row");
  }
  ColumnView view;
  view.rows_ = rows;
  view.first_run_ = std::move(first_run);
  view.runs_ = std::move(runs);
  return view;
}

LabelImage ColumnView::to_labels(int heading) const {
  SEMVIEW_CHECK(heading == 0 || columns() % PoseGrid::kHeadings == 0);
  LabelImage labels(rows_, columns());
  for (int c = 0; c < columns(); ++c) {
    int row = 0;
    const int source = heading == 0 ? c : PoseGrid::source_column(c, heading, columns());
    for (const Run& run : column(source)) {
      for (; row < run.end_row; ++row) labels.at(row, c) = run.label;
    }
  }
  return labels;
}

}  // namespace semview
