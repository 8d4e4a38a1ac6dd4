// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/heat_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "semview/similarity/view_sweep.hpp"

namespace semview::similarity {
namespace {

constexpr std::uint8_t kNoHeading = 255;

struct Bounds {
  CellIndex low{std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max()};
  CellIndex high{std::numeric_limits<std::int32_t>::min(),
                 std::numeric_limits<std::int32_t>::min()};

  std::int64_t columns() const { return std::int64_t{high.ix} - low.ix + 1; }
  std::int64_t rows() const { return std::int64_t{high.iy} - low.iy + 1; }
};

Result<Bounds> bounds_of(std::span<const CellIndex> cells) {
  if (cells.empty()) return fail(ErrorCode::kInvalidArgument, "heat map: no cells");
  Bounds bounds;
  for (const CellIndex& cell : cells) {
    bounds.low = {std::min(bounds.low.ix, cell.ix), std::min(bounds.low.iy, cell.iy)};
    bounds.high = {std::max(bounds.high.ix, cell.ix), std::max(bounds.high.iy, cell.iy)};
  }
  if (bounds.columns() > kMaxHeatMapPixels / bounds.rows()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("heat map: {} x {} cells, expected at most {} in all",
                            bounds.columns(),
                            bounds.rows(),
                            kMaxHeatMapPixels));
  }
  return bounds;
}

/// Cells to ask about: distinct, so that no two threads write one pixel.
std::vector<CellIndex> distinct(std::span<const CellIndex> requested) {
  std::vector<CellIndex> cells(requested.begin(), requested.end());
  std::ranges::sort(cells);
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

ScoreRequest at_headings(std::span<const CellIndex> cells, std::span<const int> headings) {
  ScoreRequest request;
  for (const CellIndex& cell : cells) {
    Pose2 pose = PoseGrid::center(cell);
    for (const int heading : headings) {
      pose.yaw_rad = PoseGrid::heading_yaw_rad(heading);
      request.poses.push_back(pose);
    }
  }
  return request;
}

/// @param sums  of the cell, one each of `headings`; all 120 with a `cell_weight`
void take_cell(const ScoreBatch& batch,
               std::span<const std::int32_t> sums,
               std::span<const int> headings,
               const CellIndex& cell,
               const CellWeight& cell_weight,
               HeatMap& map) {
  std::int32_t highest = kNoView;
  int best = 0;
  for (std::size_t i = 0; i < headings.size(); ++i) {
    const std::int32_t sum = sums[cell_weight ? static_cast<std::size_t>(headings[i]) : i];
    if (sum <= highest) continue;
    highest = sum;
    best = headings[i];
  }
  if (highest == kNoView) return;
  const int row = cell.iy - map.origin.iy;
  const int column = cell.ix - map.origin.ix;
  map.similarity.at(row, column) = static_cast<float>(batch.similarity(highest));
  map.best_heading.at(row, column) = static_cast<std::uint8_t>(best);
  if (!cell_weight) return;
  std::array<double, PoseGrid::kHeadings> similarities{};
  std::ranges::transform(
      sums, similarities.begin(), [&batch](std::int32_t sum) { return batch.similarity(sum); });
  map.log_weight.at(row, column) = cell_weight(similarities);
}

HeatMap unscored(const Bounds& bounds, bool with_log_weight) {
  const auto rows = static_cast<int>(bounds.rows());
  const auto columns = static_cast<int>(bounds.columns());
  HeatMap map;
  map.origin = bounds.low;
  map.similarity = Image<float>(rows, columns, std::numeric_limits<float>::quiet_NaN());
  map.best_heading = Image<std::uint8_t>(rows, columns, kNoHeading);
  if (with_log_weight) {
    map.log_weight = Image<double>(rows, columns, std::numeric_limits<double>::quiet_NaN());
  }
  return map;
}

}  // namespace

GridKey HeatMap::highest(const Image<float>& values) const {
  GridKey key{origin, 0};
  float highest = -std::numeric_limits<float>::infinity();
  for (int r = 0; r < values.rows(); ++r) {
    for (int c = 0; c < values.columns(); ++c) {
      if (!(values.at(r, c) > highest)) continue;
      highest = values.at(r, c);
      key = {{origin.ix + c, origin.iy + r}, best_heading.at(r, c)};
    }
  }
  return key;
}

Result<HeatMap> heat_map(const PreparedObservation& observation,
                         ViewSource& views,
                         std::span<const CellIndex> requested,
                         int headings,
                         ThreadPool& pool,
                         const std::function<bool(std::size_t, std::size_t)>& progress,
                         const CellWeight& cell_weight) {
  if (headings < 1 || PoseGrid::kHeadings % headings != 0) {
    return fail(
        Error{ErrorCode::kInvalidArgument,
              fmt::format(
                  "heat map: {} headings, expected a divisor of {}", headings, PoseGrid::kHeadings),
              "headings"});
  }
  SEMVIEW_TRY(const Bounds bounds, bounds_of(requested));
  const std::vector<CellIndex> cells = distinct(requested);
  const int step = PoseGrid::kHeadings / headings;
  HeatMap map = unscored(bounds, cell_weight != nullptr);
  const auto visit = [&](std::size_t i, const ColumnView* view) {
    if (view == nullptr) return;
    std::array<std::int32_t, PoseGrid::kHeadings> sums{};
    observation.all_headings(*view, sums);
    std::size_t best = 0;
    for (std::size_t k = 0; k < sums.size(); k += static_cast<std::size_t>(step)) {
      if (sums[k] > sums[best]) best = k;
    }
    const int row = cells[i].iy - map.origin.iy;
    const int column = cells[i].ix - map.origin.ix;
    map.similarity.at(row, column) = static_cast<float>(observation.similarity(sums[best]));
    map.best_heading.at(row, column) = static_cast<std::uint8_t>(best);
    if (!cell_weight) return;
    std::array<double, PoseGrid::kHeadings> similarities{};
    std::ranges::transform(sums, similarities.begin(), [&observation](std::int32_t sum) {
      return observation.similarity(sum);
    });
    map.log_weight.at(row, column) = cell_weight(similarities);
  };
  const auto report = [&](std::size_t done) { return progress(done, cells.size()); };
  SEMVIEW_TRY(map.origins,
              sweep_views(observation,
                          views,
                          cells,
                          pool,
                          visit,
                          progress ? report : std::function<bool(std::size_t)>()));
  return map;
}

Result<HeatMap> heat_map(ScoreSource& source,
                         std::span<const CellIndex> requested,
                         std::span<const int> headings,
                         const std::function<bool(std::size_t, std::size_t)>& progress,
                         const CellWeight& cell_weight) {
  const bool on_grid =
      !headings.empty() && headings.front() >= 0 && headings.back() < PoseGrid::kHeadings &&
      std::ranges::adjacent_find(headings, std::ranges::greater_equal()) == headings.end();
  if (!on_grid) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("heat map: {} headings; expected some of the {}, increasing",
                                  headings.size(),
                                  PoseGrid::kHeadings),
                      "headings"});
  }
  SEMVIEW_TRY(const Bounds bounds, bounds_of(requested));
  const std::vector<CellIndex> cells = distinct(requested);
  HeatMap map = unscored(bounds, cell_weight != nullptr);
  const std::vector<int> all = even_headings(PoseGrid::kHeadings);
  const std::span<const int> asked = cell_weight ? std::span<const int>(all) : headings;
  constexpr std::size_t kPosesAtOnce = 16'384;
  const std::size_t at_once = std::max<std::size_t>(kPosesAtOnce / asked.size(), 1);
  for (std::size_t first = 0; first < cells.size(); first += at_once) {
    const auto some = std::span(cells).subspan(first, std::min(at_once, cells.size() - first));
    SEMVIEW_TRY(const ScoreBatch batch, source.score(at_headings(some, asked)));
    if (batch.sums.size() != some.size() * asked.size()) {
      return fail(ErrorCode::kInternal,
                  fmt::format("heat map: the score source answered {} sums of {} poses",
                              batch.sums.size(),
                              some.size() * asked.size()));
    }
    for (std::size_t i = 0; i < some.size(); ++i) {
      take_cell(batch,
                std::span(batch.sums).subspan(i * asked.size(), asked.size()),
                headings,
                some[i],
                cell_weight,
                map);
    }
    map.origins += batch.origins;
    const std::size_t done = first + some.size();
    if (progress && !progress(done, cells.size())) {
      return fail(ErrorCode::kCancelled, "heat map: cancelled");
    }
  }
  return map;
}

std::vector<int> even_headings(int count) {
  std::vector<int> headings;
  for (int i = 0; i < count; ++i) {
    headings.push_back((2 * i * PoseGrid::kHeadings + count) / (2 * count));
  }
  return headings;
}

}  // namespace semview::similarity
