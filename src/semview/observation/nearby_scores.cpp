// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/nearby_scores.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "semview/geometry/pose_grid.hpp"

namespace semview::observation {
namespace {

constexpr int kReach = 2;  // cells
constexpr int kSide = 2 * kReach + 1;
constexpr std::size_t kCells = std::size_t{kSide} * kSide;
constexpr int kHeadings = PoseGrid::kHeadings;
constexpr int kNearHeadings = 2;  // 6°
constexpr double kFarthest_m = 0.15;

/// Where a cell's similarity is highest among headings near the pose's.
struct Top {
  double similarity = 0.0;
  double yaw_rad = 0.0;
};

std::optional<Top> top_of(const NearbyScores& nearby, std::size_t cell) {
  const auto curve =
      std::span(nearby.batch.curve)
          .subspan(cell * static_cast<std::size_t>(kHeadings), static_cast<std::size_t>(kHeadings));
  if (curve[0] == kNoView) return std::nullopt;
  const auto at = [&](int k) {
    const std::int32_t sum = curve[static_cast<std::size_t>((k + 2 * kHeadings) % kHeadings)];
    return nearby.batch.similarity(sum);
  };
  const int middle = PoseGrid::heading(nearby.around.yaw_rad);
  int best = middle;
  for (int k = middle - kNearHeadings; k <= middle + kNearHeadings; ++k) {
    if (at(k) > at(best)) best = k;
  }
  const double bend = at(best - 1) - 2.0 * at(best) + at(best + 1);
  const double slope = 0.5 * (at(best + 1) - at(best - 1));
  double step = bend < 0.0 ? -slope / bend : 0.0;
  if (std::abs(step) > 0.5) step = 0.0;  // an end of the search, no top
  return Top{at(best) + 0.5 * slope * step, wrap_angle((best + step) * kTwoPi / kHeadings)};
}

/// The cell at (dx, dy) from the middle one.
std::size_t cell_at(int dx, int dy) {
  return static_cast<std::size_t>((dy + kReach) * kSide + dx + kReach);
}

}  // namespace

Result<NearbyScores> score_nearby(ScoreSource& source,
                                  const Pose2& map_from_eye,
                                  const MapAffine& affine) {
  const std::optional<CellIndex> middle = PoseGrid::cell(map_from_eye.x_m, map_from_eye.y_m);
  if (!middle) {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format(
            "the pose ({:g}, {:g}) is not on the grid", map_from_eye.x_m, map_from_eye.y_m));
  }
  ScoreRequest request;
  request.mode = HeadingMode::kCompass;
  request.whole_curve = true;
  for (int dy = -kReach; dy <= kReach; ++dy) {
    for (int dx = -kReach; dx <= kReach; ++dx) {
      request.poses.push_back(PoseGrid::center(CellIndex{middle->ix + dx, middle->iy + dy}));
    }
  }
  if (!affine.is_identity()) request.affines.assign(kCells, affine);
  NearbyScores nearby;
  nearby.around = map_from_eye;
  SEMVIEW_TRY(nearby.batch, source.score(request));
  if (nearby.batch.curve.size() != kCells * kHeadings || nearby.batch.weight_scale < 1 ||
      nearby.batch.observed_pixels < 1) {
    return fail(
        ErrorCode::kInternal,
        fmt::format(
            "the score source answered {} sums of {} curves", nearby.batch.curve.size(), kCells));
  }
  return nearby;
}

std::optional<double> best_similarity(const NearbyScores& nearby) {
  std::optional<double> best;
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    const std::optional<Top> top = top_of(nearby, cell);
    if (top && !(best && *best >= top->similarity)) best = top->similarity;
  }
  return best;
}

std::optional<Pose2> refined_pose(const NearbyScores& nearby) {
  const CellIndex middle = *PoseGrid::cell(nearby.around.x_m, nearby.around.y_m);
  // similarity = c0 + c1 x + c2 y + c3 x² + c4 xy + c5 y², in cells from the middle one.
  Eigen::Matrix<double, static_cast<int>(kCells), 6> terms;
  Eigen::Matrix<double, static_cast<int>(kCells), 1> values;
  for (int dy = -kReach; dy <= kReach; ++dy) {
    for (int dx = -kReach; dx <= kReach; ++dx) {
      const std::size_t cell = cell_at(dx, dy);
      const std::optional<Top> top = top_of(nearby, cell);
      if (!top) return std::nullopt;
      terms.row(static_cast<Eigen::Index>(cell)) << 1.0, dx, dy, dx * dx, dx * dy, dy * dy;
      values(static_cast<Eigen::Index>(cell)) = top->similarity;
    }
  }
  const Eigen::Matrix<double, 6, 1> c =
      (terms.transpose() * terms).ldlt().solve(terms.transpose() * values);
  const double determinant = 4.0 * c(3) * c(5) - c(4) * c(4);
  if (!(c(3) < 0.0) || !(determinant > 0.0)) return std::nullopt;
  const double x = (c(4) * c(2) - 2.0 * c(5) * c(1)) / determinant;
  const double y = (c(4) * c(1) - 2.0 * c(3) * c(2)) / determinant;
  const Pose2 center = PoseGrid::center(middle);
  Pose2 refined{
      center.x_m + x * PoseGrid::kCellSize_m, center.y_m + y * PoseGrid::kCellSize_m, 0.0};
  if (distance_m(refined, nearby.around) > kFarthest_m) return std::nullopt;
  const auto nearest = [](double offset) {
    return std::min(kReach, std::max(-kReach, static_cast<int>(std::lround(offset))));
  };
  refined.yaw_rad = top_of(nearby, cell_at(nearest(x), nearest(y)))->yaw_rad;
  return refined;
}

}  // namespace semview::observation
