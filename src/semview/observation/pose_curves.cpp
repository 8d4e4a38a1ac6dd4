// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/pose_curves.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace semview::observation {
namespace {

/// Two megabytes of sums a call, below what a server takes at once.
constexpr std::size_t kCellsPerCall = 4096;

struct DistinctCells {
  ScoreRequest request;  ///< one pose a cell
  std::vector<std::size_t> cell_of_pose;
};

Result<DistinctCells> distinct_cells(const ScoreRequest& request) {
  DistinctCells distinct;
  distinct.request.mode = HeadingMode::kCompass;
  distinct.request.whole_curve = true;
  std::map<std::pair<CellIndex, MapAffine>, std::size_t> index;
  for (std::size_t i = 0; i < request.poses.size(); ++i) {
    const Pose2& pose = request.poses[i];
    const std::optional<CellIndex> cell = PoseGrid::cell(pose.x_m, pose.y_m);
    if (!cell) {
      return fail(
          Error{ErrorCode::kInvalidArgument,
                fmt::format(
                    "pose {} ({:g}, {:g}) is not finite or not on the grid", i, pose.x_m, pose.y_m),
                "poses"});
    }
    const MapAffine affine =
        request.affines.empty() ? MapAffine{} : on_affine_grid(request.affines[i]);
    const auto [entry, is_new] = index.try_emplace({*cell, affine}, distinct.request.poses.size());
    distinct.cell_of_pose.push_back(entry->second);
    if (!is_new) continue;
    distinct.request.poses.push_back(pose);
    if (!request.affines.empty()) distinct.request.affines.push_back(affine);
  }
  return distinct;
}

ScoreRequest part_of(const ScoreRequest& whole, std::size_t first, std::size_t end) {
  ScoreRequest part;
  part.mode = whole.mode;
  part.whole_curve = whole.whole_curve;
  const auto cut = [first, end](const auto& from, auto& to) {
    if (from.empty()) return;
    to.assign(from.begin() + static_cast<std::ptrdiff_t>(first),
              from.begin() + static_cast<std::ptrdiff_t>(end));
  };
  cut(whole.poses, part.poses);
  cut(whole.affines, part.affines);
  return part;
}

Status append(const ScoreBatch& part, std::size_t cells, ScoreBatch& whole) {
  const bool same_scale = whole.sums.empty() || (part.weight_scale == whole.weight_scale &&
                                                 part.observed_pixels == whole.observed_pixels);
  if (part.sums.size() != cells || part.best_heading.size() != cells ||
      part.curve.size() != cells * PoseGrid::kHeadings || part.weight_scale < 1 ||
      part.observed_pixels < 1 || !same_scale) {
    return fail(ErrorCode::kInternal,
                fmt::format("the score source answered {} sums and {} of curves of {} cells "
                            "(scale {}, {} observed pixels)",
                            part.sums.size(),
                            part.curve.size(),
                            cells,
                            part.weight_scale,
                            part.observed_pixels));
  }
  whole.weight_scale = part.weight_scale;
  whole.observed_pixels = part.observed_pixels;
  whole.sums.insert(whole.sums.end(), part.sums.begin(), part.sums.end());
  whole.best_heading.insert(
      whole.best_heading.end(), part.best_heading.begin(), part.best_heading.end());
  whole.curve.insert(whole.curve.end(), part.curve.begin(), part.curve.end());
  whole.origins += part.origins;
  return {};
}

}  // namespace

Result<PoseCurves> score_curves(ScoreSource& source, const ScoreRequest& request) {
  SEMVIEW_TRY(DistinctCells distinct, distinct_cells(request));
  const std::size_t cells = distinct.request.poses.size();
  PoseCurves curves;
  curves.cell_of_pose = std::move(distinct.cell_of_pose);
  for (std::size_t first = 0; first < cells; first += kCellsPerCall) {
    const std::size_t end = std::min(first + kCellsPerCall, cells);
    SEMVIEW_TRY(const ScoreBatch part, source.score(part_of(distinct.request, first, end)));
    SEMVIEW_TRY_STATUS(append(part, end - first, curves.batch));
  }
  ScoreBatch& batch = curves.batch;
  const std::vector<std::int32_t> cell_sums = std::exchange(batch.sums, {});
  const std::vector<std::uint8_t> cell_headings = std::exchange(batch.best_heading, {});
  for (const std::size_t cell : curves.cell_of_pose) {
    batch.sums.push_back(cell_sums[cell]);
    batch.best_heading.push_back(cell_headings[cell]);
  }
  return curves;
}

}  // namespace semview::observation
