// SPDX-License-Identifier: Apache-2.0
#include "semview/view/column_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/geometry/pose_grid.hpp"

namespace semview {
namespace {

bool meets_nothing(const RunPlane& plane) { return plane.a_per_m == 0.0F && plane.b_per_m == 0.0F; }

/// Null if every run has the plane that its class asks for.
const char* wrong_with_planes(const std::vector<Run>& runs, const std::vector<RunPlane>& planes) {
  if (planes.empty()) return nullptr;
  if (planes.size() != runs.size()) return "view: not one plane a run";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!std::isfinite(planes[i].a_per_m) || !std::isfinite(planes[i].b_per_m)) {
      return "view: a plane is not finite";
    }
    if (meets_nothing(planes[i]) != (runs[i].label == kNoHit)) {
      return "view: a plane does not fit its run's class";
    }
  }
  return nullptr;
}

float range_m(const RunPlane& plane, double cosine, double sine) {
  const double inverse = plane.a_per_m * cosine + plane.b_per_m * sine;
  return inverse > 0.0 ? static_cast<float>(1.0 / inverse) : std::numeric_limits<float>::infinity();
}

}  // namespace

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
                                         std::vector<Run> runs,
                                         std::vector<RunPlane> planes) {
  const auto broken = [](std::size_t column, const char* what) {
    return fail(ErrorCode::kDataLoss, fmt::format("view: column {}: {}", column, what));
  };
  if (first_run.empty() || first_run.front() != 0 || first_run.back() != runs.size()) {
    return fail(ErrorCode::kDataLoss, "view: run offsets do not cover the runs");
  }
  if (const char* wrong = wrong_with_planes(runs, planes)) return fail(ErrorCode::kDataLoss, wrong);
  for (std::size_t c = 0; c + 1 < first_run.size(); ++c) {
    if (first_run[c] >= first_run[c + 1] || first_run[c + 1] > runs.size()) {
      return broken(c, "run offsets do not increase");
    }
    int start = 0;
    for (std::size_t i = first_run[c]; i < first_run[c + 1]; ++i) {
      if (runs[i].end_row <= start) return broken(c, "empty run");
      if (i > first_run[c] && runs[i].label == runs[i - 1].label &&
          (planes.empty() || planes[i] == planes[i - 1])) {
        return broken(c, "neighbouring runs of one surface");
      }
      start = runs[i].end_row;
    }
    if (start != rows) return broken(c, "the last run does not end at the last row");
  }
  return assemble(rows, std::move(first_run), std::move(runs), std::move(planes));
}

ColumnView ColumnView::from_canonical_runs(int rows,
                                           std::vector<std::uint32_t> first_run,
                                           std::vector<Run> runs,
                                           std::vector<RunPlane> planes) {
  SEMVIEW_ASSERT(from_runs(rows, first_run, runs, planes).has_value());
  return assemble(rows, std::move(first_run), std::move(runs), std::move(planes));
}

ColumnView ColumnView::assemble(int rows,
                                std::vector<std::uint32_t> first_run,
                                std::vector<Run> runs,
                                std::vector<RunPlane> planes) {
  ColumnView view;
  view.rows_ = rows;
  view.first_run_ = std::move(first_run);
  view.runs_ = std::move(runs);
  view.planes_ = std::move(planes);
  return view;
}

ColumnView ColumnView::without_ranges() const {
  if (!has_ranges()) return *this;
  ColumnView view;
  view.rows_ = rows_;
  view.first_run_.reserve(first_run_.size());
  for (int c = 0; c < columns(); ++c) {
    const std::size_t first = view.runs_.size();
    view.first_run_.push_back(static_cast<std::uint32_t>(first));
    for (const Run& run : column(c)) {
      if (view.runs_.size() > first && view.runs_.back().label == run.label) view.runs_.pop_back();
      view.runs_.push_back(run);
    }
  }
  view.first_run_.push_back(static_cast<std::uint32_t>(view.runs_.size()));
  view.runs_.shrink_to_fit();
  return view;
}

ColumnView ColumnView::arranged(std::span<const std::uint32_t> columns) const {
  // Runs are copied this many at once, the next column overwriting what was too much: in no order
  // of columns can a processor foresee how many runs each has.
  constexpr std::uint32_t kAtOnce = 4;
  ColumnView view;
  view.rows_ = rows_;
  view.first_run_.reserve(columns.size() + 1);
  view.first_run_.push_back(0);
  for (const std::uint32_t c : columns) {
    view.first_run_.push_back(view.first_run_.back() + first_run_[c + 1] - first_run_[c]);
  }
  view.runs_.resize(view.first_run_.back());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::uint32_t from = first_run_[columns[c]];
    const std::uint32_t count = first_run_[columns[c] + 1] - from;
    const std::uint32_t to = view.first_run_[c];
    if (from + count + kAtOnce <= runs_.size() && to + count + kAtOnce <= view.runs_.size()) {
      for (std::uint32_t i = 0; i < count; i += kAtOnce) {
        std::copy_n(&runs_[from + i], kAtOnce, &view.runs_[to + i]);
      }
    } else {
      std::copy_n(runs_.begin() + from, count, view.runs_.begin() + to);
    }
    if (has_ranges()) {
      view.planes_.insert(
          view.planes_.end(), planes_.begin() + from, planes_.begin() + from + count);
    }
  }
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

RangeImage ColumnView::to_ranges(const PanoramaCamera& camera, int heading) const {
  SEMVIEW_CHECK(has_ranges() && camera.columns == columns() && camera.rows == rows_);
  SEMVIEW_CHECK(heading == 0 || columns() % PoseGrid::kHeadings == 0);
  std::vector<double> cosine(static_cast<std::size_t>(rows_));
  std::vector<double> sine(cosine.size());
  for (int r = 0; r < rows_; ++r) {
    cosine[static_cast<std::size_t>(r)] = std::cos(camera.elevation_rad(r));
    sine[static_cast<std::size_t>(r)] = std::sin(camera.elevation_rad(r));
  }
  RangeImage ranges(rows_, columns());
  for (int c = 0; c < columns(); ++c) {
    const int source = heading == 0 ? c : PoseGrid::source_column(c, heading, columns());
    std::size_t row = 0;
    const auto index = static_cast<std::size_t>(source);
    for (std::size_t i = first_run_[index]; i < first_run_[index + 1]; ++i) {
      for (; row < runs_[i].end_row; ++row) {
        ranges.at(static_cast<int>(row), c) = range_m(planes_[i], cosine[row], sine[row]);
      }
    }
  }
  return ranges;
}

}  // namespace semview
