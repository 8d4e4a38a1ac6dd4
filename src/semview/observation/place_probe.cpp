// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/place_probe.hpp"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "semview/observation/nearby_scores.hpp"

namespace semview::observation {

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
  ScoreRequest request;
  request.mode = HeadingMode::kCompass;
  for (const CellIndex& cell : cells) request.poses.push_back(PoseGrid::center(cell));
  if (!affine.is_identity()) request.affines.assign(cells.size(), affine);
  SEMVIEW_TRY(const ScoreBatch batch, source.score(request));
  if (batch.sums.size() != cells.size() || batch.weight_scale < 1 || batch.observed_pixels < 1) {
    return fail(ErrorCode::kInternal,
                fmt::format("the score source answered {} sums of {} cells (scale {}, {} observed "
                            "pixels)",
                            batch.sums.size(),
                            cells.size(),
                            batch.weight_scale,
                            batch.observed_pixels));
  }
  std::int32_t best = kNoView;
  std::int64_t total = 0;
  std::int64_t viewed = 0;
  for (const std::int32_t sum : batch.sums) {
    if (sum == kNoView) continue;
    best = std::max(best, sum);
    total += sum;
    ++viewed;
  }
  PlaceScores scores;
  if (viewed > 0) {
    scores.anywhere = batch.similarity(best);
    scores.anywhere_mean = static_cast<double>(total) / static_cast<double>(viewed) /
                           (static_cast<double>(batch.weight_scale) * batch.observed_pixels);
  }
  SEMVIEW_TRY(const NearbyScores nearby, score_nearby(source, map_from_eye, affine));
  scores.here = best_similarity(nearby).value_or(scores.anywhere_mean);
  return scores;
}

}  // namespace semview::observation
