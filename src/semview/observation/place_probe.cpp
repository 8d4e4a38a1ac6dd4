// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/place_probe.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

#include <fmt/format.h>

namespace semview::observation {
namespace {

constexpr double kNear_m = 1.0;
constexpr std::int32_t kNearCells = 8;     // to each side
constexpr std::int32_t kNearSpacing = 2;   // cells
constexpr int kNearHeadings = 10;          // to each side: 30°
constexpr std::size_t kBestElsewhere = 8;  // probe cells whose neighbours are looked at
constexpr std::int32_t kAround = 2;        // cells: what lies between the probe cells

Result<ScoreBatch> score_cells(ScoreSource& source,
                               const std::vector<CellIndex>& cells,
                               const MapAffine& affine,
                               bool whole_curve) {
  ScoreRequest request;
  request.mode = HeadingMode::kCompass;
  request.whole_curve = whole_curve;
  for (const CellIndex& cell : cells) request.poses.push_back(PoseGrid::center(cell));
  if (!affine.is_identity()) request.affines.assign(cells.size(), affine);
  SEMVIEW_TRY(ScoreBatch batch, source.score(request));
  const std::size_t curve = whole_curve ? cells.size() * PoseGrid::kHeadings : 0;
  if (batch.sums.size() == cells.size() && batch.curve.size() == curve && batch.weight_scale > 0 &&
      batch.observed_pixels > 0) {
    return batch;
  }
  return fail(ErrorCode::kInternal,
              fmt::format("the score source answered {} sums and {} of curves of {} cells (scale "
                          "{}, {} observed pixels)",
                          batch.sums.size(),
                          batch.curve.size(),
                          cells.size(),
                          batch.weight_scale,
                          batch.observed_pixels));
}

/// The best sum near the pose at headings near its own; `kNoView` if nothing can be seen there.
Result<std::optional<double>> best_here(ScoreSource& source,
                                        const Pose2& pose,
                                        const MapAffine& affine) {
  const std::optional<CellIndex> middle = PoseGrid::cell(pose.x_m, pose.y_m);
  if (!middle) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("the pose ({:g}, {:g}) is not on the grid", pose.x_m, pose.y_m));
  }
  std::vector<CellIndex> cells;
  for (std::int32_t dy = -kNearCells; dy <= kNearCells; dy += kNearSpacing) {
    for (std::int32_t dx = -kNearCells; dx <= kNearCells; dx += kNearSpacing) {
      const CellIndex cell{middle->ix + dx, middle->iy + dy};
      if (distance_m(PoseGrid::center(cell), pose) < kNear_m) cells.push_back(cell);
    }
  }
  SEMVIEW_TRY(const ScoreBatch batch, score_cells(source, cells, affine, true));
  std::int32_t best = kNoView;
  const int heading = PoseGrid::heading(pose.yaw_rad);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (int k = heading - kNearHeadings; k <= heading + kNearHeadings; ++k) {
      const auto at = static_cast<std::size_t>((k + PoseGrid::kHeadings) % PoseGrid::kHeadings);
      best = std::max(best, batch.curve[i * PoseGrid::kHeadings + at]);
    }
  }
  if (best == kNoView) return std::optional<double>();
  return std::optional<double>(batch.similarity(best));
}

struct Probed {
  CellIndex cell;
  std::int32_t sum = 0;
};

/// The best sum around the best of `elsewhere`.
Result<std::int32_t> best_around(ScoreSource& source,
                                 std::vector<Probed> elsewhere,
                                 const MapAffine& affine) {
  const std::size_t count = std::min(kBestElsewhere, elsewhere.size());
  std::partial_sort(elsewhere.begin(),
                    elsewhere.begin() + static_cast<std::ptrdiff_t>(count),
                    elsewhere.end(),
                    [](const Probed& a, const Probed& b) {
                      return a.sum != b.sum ? a.sum > b.sum : a.cell < b.cell;
                    });
  std::vector<CellIndex> cells;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::int32_t dy = -kAround; dy <= kAround; ++dy) {
      for (std::int32_t dx = -kAround; dx <= kAround; ++dx) {
        cells.push_back({elsewhere[i].cell.ix + dx, elsewhere[i].cell.iy + dy});
      }
    }
  }
  SEMVIEW_TRY(const ScoreBatch batch, score_cells(source, cells, affine, false));
  return *std::ranges::max_element(batch.sums);
}

}  // namespace

std::vector<CellIndex> probe_cells(std::vector<CellIndex> free_cells) {
  std::ranges::sort(free_cells);
  for (std::int32_t spacing = 4;; spacing *= 2) {
    std::vector<CellIndex> spread;
    for (const CellIndex& cell : free_cells) {
      if (cell.ix % spacing == 0 && cell.iy % spacing == 0) spread.push_back(cell);
    }
    if (spread.empty() && free_cells.size() <= kMostProbeCells) return free_cells;
    if (spread.size() <= kMostProbeCells) return spread;
  }
}

Result<PlaceScores> probe_place(ScoreSource& source,
                                const Pose2& map_from_eye,
                                const std::vector<CellIndex>& cells,
                                const MapAffine& affine) {
  SEMVIEW_TRY(const std::optional<double> here, best_here(source, map_from_eye, affine));
  SEMVIEW_TRY(const ScoreBatch batch, score_cells(source, cells, affine, false));
  std::vector<Probed> elsewhere;
  std::int64_t total = 0;
  std::int64_t viewed = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (batch.sums[i] == kNoView) continue;
    total += batch.sums[i];
    ++viewed;
    if (distance_m(PoseGrid::center(cells[i]), map_from_eye) > kNear_m) {
      elsewhere.push_back({cells[i], batch.sums[i]});
    }
  }
  PlaceScores scores;
  if (viewed > 0) {
    scores.mean = static_cast<double>(total) / static_cast<double>(viewed) /
                  (static_cast<double>(batch.weight_scale) * batch.observed_pixels);
  }
  scores.here = here.value_or(scores.mean);
  scores.elsewhere = scores.mean;
  if (!elsewhere.empty()) {
    SEMVIEW_TRY(const std::int32_t best, best_around(source, std::move(elsewhere), affine));
    scores.elsewhere = batch.similarity(best);
  }
  return scores;
}

}  // namespace semview::observation
