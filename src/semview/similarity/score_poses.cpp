// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/score_poses.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "semview/similarity/view_sweep.hpp"

namespace semview::similarity {
namespace {

constexpr std::size_t kHeadings = PoseGrid::kHeadings;

/// The poses of the request that share a cell: `order[first, last)`.
struct CellGroup {
  std::size_t first = 0;
  std::size_t last = 0;
};

struct Grouping {
  std::vector<std::uint8_t> headings;  ///< one a pose
  std::vector<std::size_t> order;      ///< pose indices, sorted by cell and heading
  std::vector<CellIndex> cells;        ///< distinct, sorted
  std::vector<CellGroup> groups;       ///< one a cell
};

Result<Grouping> group_by_cell(const std::vector<Pose2>& poses) {
  Grouping grouping;
  std::vector<CellIndex> cell_of;
  cell_of.reserve(poses.size());
  grouping.headings.reserve(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::optional<GridKey> key = PoseGrid::key(poses[i]);
    if (!key) {
      return fail(Error{ErrorCode::kInvalidArgument,
                        fmt::format("pose {} ({:g}, {:g}, {:g}) is not finite or not on the grid",
                                    i,
                                    poses[i].x_m,
                                    poses[i].y_m,
                                    poses[i].yaw_rad),
                        "poses"});
    }
    cell_of.push_back(key->cell);
    grouping.headings.push_back(static_cast<std::uint8_t>(key->heading));
    grouping.order.push_back(i);
  }
  std::ranges::sort(grouping.order, [&](std::size_t a, std::size_t b) {
    if (cell_of[a] != cell_of[b]) return cell_of[a] < cell_of[b];
    return grouping.headings[a] < grouping.headings[b];
  });
  for (std::size_t i = 0; i < grouping.order.size(); ++i) {
    const CellIndex& cell = cell_of[grouping.order[i]];
    if (grouping.cells.empty() || grouping.cells.back() != cell) {
      grouping.cells.push_back(cell);
      grouping.groups.push_back({i, i});
    }
    grouping.groups.back().last = i + 1;
  }
  return grouping;
}

/// Writes the answers of one cell's poses.
class CellScorer {
 public:
  CellScorer(const PreparedObservation& observation,
             const ScoreRequest& request,
             const Grouping& grouping,
             ScoreBatch& batch)
      : observation_(observation), request_(request), grouping_(grouping), batch_(batch) {}

  void operator()(std::size_t cell, const ColumnView* view) const {
    const CellGroup& group = grouping_.groups[cell];
    const auto poses = std::span(grouping_.order).subspan(group.first, group.last - group.first);
    if (view == nullptr) {
      no_view(poses);
    } else if (request_.mode == HeadingMode::kCompass) {
      compass(poses, *view);
    } else {
      as_given(poses, *view);
    }
  }

 private:
  void no_view(std::span<const std::size_t> poses) const {
    for (const std::size_t pose : poses) {
      batch_.sums[pose] = kNoView;
      if (request_.mode == HeadingMode::kCompass) {
        batch_.best_heading[pose] = grouping_.headings[pose];
      }
      if (request_.whole_curve) std::ranges::fill(curve(pose), kNoView);
    }
  }

  void compass(std::span<const std::size_t> poses, const ColumnView& view) const {
    std::array<std::int32_t, kHeadings> sums{};
    observation_.all_headings(view, sums);
    const auto best = std::ranges::max_element(sums);  // the first of equals
    for (const std::size_t pose : poses) {
      batch_.sums[pose] = *best;
      batch_.best_heading[pose] = static_cast<std::uint8_t>(best - sums.begin());
      if (request_.whole_curve) std::ranges::copy(sums, curve(pose).begin());
    }
  }

  /// `poses` are in order of their headings.
  void as_given(std::span<const std::size_t> poses, const ColumnView& view) const {
    std::array<std::uint8_t, kHeadings> headings{};
    std::size_t distinct = 0;
    for (const std::size_t pose : poses) {
      const std::uint8_t heading = grouping_.headings[pose];
      if (distinct == 0 || headings[distinct - 1] != heading) headings[distinct++] = heading;
    }
    std::array<std::int32_t, kHeadings> sums{};
    observation_.some_headings(
        view, std::span(headings).first(distinct), std::span(sums).first(distinct));
    std::size_t i = 0;
    for (const std::size_t pose : poses) {
      if (headings[i] != grouping_.headings[pose]) ++i;
      batch_.sums[pose] = sums[i];
    }
  }

  std::span<std::int32_t> curve(std::size_t pose) const {
    return std::span(batch_.curve).subspan(pose * kHeadings, kHeadings);
  }

  const PreparedObservation& observation_;
  const ScoreRequest& request_;
  const Grouping& grouping_;
  ScoreBatch& batch_;
};

}  // namespace

Result<ScoreBatch> score_poses(const PreparedObservation& observation,
                               ViewSource& views,
                               const ScoreRequest& request,
                               ThreadPool& pool) {
  const bool compass = request.mode == HeadingMode::kCompass;
  if (request.whole_curve && !compass) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      "whole_curve needs the visual compass, not headings as given",
                      "whole_curve"});
  }
  SEMVIEW_TRY(const Grouping grouping, group_by_cell(request.poses));
  ScoreBatch batch;
  batch.weight_scale = observation.weight_scale();
  batch.observed_pixels = observation.observed_pixels();
  batch.sums.resize(request.poses.size());
  if (compass) batch.best_heading.resize(request.poses.size());
  if (request.whole_curve) batch.curve.resize(request.poses.size() * kHeadings);
  const CellScorer scorer(observation, request, grouping, batch);
  SEMVIEW_TRY(batch.origins, sweep_views(observation, views, grouping.cells, pool, scorer));
  return batch;
}

}  // namespace semview::similarity
