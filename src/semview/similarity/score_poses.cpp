// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/score_poses.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "semview/similarity/view_sweep.hpp"

namespace semview::similarity {
namespace {

constexpr std::size_t kHeadings = PoseGrid::kHeadings;

/// Writes the answers of one cell's poses.
class CellScorer {
 public:
  CellScorer(const PreparedObservation& observation,
             const ScoreRequest& request,
             const PoseGroups& groups,
             ScoreBatch& batch)
      : observation_(observation), request_(request), groups_(groups), batch_(batch) {}

  void operator()(std::size_t cell, const ColumnView* view) const {
    const auto poses = groups_.poses_of(cell);
    if (view == nullptr) {
      no_view(poses);
    } else if (request_.mode == HeadingMode::kCompass) {
      compass(poses, *view);
    } else {
      as_given(poses, *view);
    }
  }

 private:
  void no_view(std::span<const std::uint32_t> poses) const {
    for (const std::uint32_t pose : poses) {
      batch_.sums[pose] = kNoView;
      if (request_.mode == HeadingMode::kCompass) {
        batch_.best_heading[pose] =
            static_cast<std::uint8_t>(PoseGrid::heading(request_.poses[pose].yaw_rad));
      }
      if (request_.whole_curve) std::ranges::fill(curve(pose), kNoView);
    }
  }

  void compass(std::span<const std::uint32_t> poses, const ColumnView& view) const {
    std::array<std::int32_t, kHeadings> sums{};
    observation_.all_headings(view, sums);
    const auto best = std::ranges::max_element(sums);  // the first of equals
    for (const std::uint32_t pose : poses) {
      batch_.sums[pose] = *best;
      batch_.best_heading[pose] = static_cast<std::uint8_t>(best - sums.begin());
      if (request_.whole_curve) std::ranges::copy(sums, curve(pose).begin());
    }
  }

  /// `poses` are in order of their headings.
  void as_given(std::span<const std::uint32_t> poses, const ColumnView& view) const {
    std::array<std::uint8_t, kHeadings> headings{};
    std::size_t distinct = 0;
    for (const std::uint32_t pose : poses) {
      const std::uint8_t heading = groups_.headings[pose];
      if (distinct == 0 || headings[distinct - 1] != heading) headings[distinct++] = heading;
    }
    std::array<std::int32_t, kHeadings> sums{};
    observation_.some_headings(
        view, std::span(headings).first(distinct), std::span(sums).first(distinct));
    std::size_t i = 0;
    for (const std::uint32_t pose : poses) {
      if (headings[i] != groups_.headings[pose]) ++i;
      batch_.sums[pose] = sums[i];
    }
  }

  std::span<std::int32_t> curve(std::size_t pose) const {
    return std::span(batch_.curve).subspan(pose * kHeadings, kHeadings);
  }

  const PreparedObservation& observation_;
  const ScoreRequest& request_;
  const PoseGroups& groups_;
  ScoreBatch& batch_;
};

}  // namespace

Result<ScoreBatch> unscored_batch(const PreparedObservation& observation,
                                  const ScoreRequest& request) {
  const bool compass = request.mode == HeadingMode::kCompass;
  if (request.whole_curve && !compass) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      "whole_curve needs the visual compass, not headings as given",
                      "whole_curve"});
  }
  ScoreBatch batch;
  batch.weight_scale = observation.weight_scale();
  batch.observed_pixels = observation.observed_pixels();
  batch.sums.resize(request.poses.size());
  if (compass) batch.best_heading.resize(request.poses.size());
  if (request.whole_curve) batch.curve.resize(request.poses.size() * kHeadings);
  return batch;
}

Result<ViewOrigins> score_cells(const PreparedObservation& observation,
                                ViewSource& views,
                                const ScoreRequest& request,
                                const PoseGroups& groups,
                                CellRange range,
                                ThreadPool& pool,
                                ScoreBatch& batch) {
  const CellScorer scorer(observation, request, groups, batch);
  const auto cells = std::span(groups.cells).subspan(range.begin, range.end - range.begin);
  return sweep_views(
      observation, views, cells, pool, [&scorer, range](std::size_t i, const ColumnView* view) {
        scorer(range.begin + i, view);
      });
}

Result<ScoreBatch> score_poses(const PreparedObservation& observation,
                               ViewSource& views,
                               const ScoreRequest& request,
                               ThreadPool& pool) {
  SEMVIEW_TRY(ScoreBatch batch, unscored_batch(observation, request));
  SEMVIEW_TRY(const PoseGroups groups, group_by_cell(request.poses, request.mode));
  const CellRange all{0, groups.cells.size()};
  SEMVIEW_TRY(batch.origins, score_cells(observation, views, request, groups, all, pool, batch));
  return batch;
}

}  // namespace semview::similarity
