// SPDX-License-Identifier: Apache-2.0
#include "semview/places/place_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "semview/geometry/angle.hpp"

namespace semview::places {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();
/// Columns to either side that are tried at each place.
constexpr int kTurns = 2;

/// A place with its best heading in whole columns.
struct Footing {
  double x_m = 0.0;
  double y_m = 0.0;
  double eye_height_m = 0.0;
  int turn = 0;
  double score = kNever;
};

class Climb {
 public:
  Climb(const ColumnScorer& scorer, const ExactView& exact_view, const RefinementConfig& config)
      : scorer_(scorer), exact_view_(exact_view), config_(config) {}

  EyePlacement run(const EyePlacement& start) {
    const double column_rad = kTwoPi / scorer_.columns();
    const int turn = static_cast<int>(std::lround(start.map_from_eye.yaw_rad / column_rad));
    first_height_m_ = start.eye_height_m;
    best_ = try_at(start.map_from_eye.x_m, start.map_from_eye.y_m, start.eye_height_m, turn, 4);
    for (double step_m = config_.first_step_m; step_m >= config_.last_step_m; step_m /= 2.0) {
      for (int move = 0; move < config_.most_moves; ++move) {
        if (!step(step_m)) break;
      }
    }
    return placement(column_rad);
  }

 private:
  Footing try_at(double x_m, double y_m, double height_m, int turn, int turns) const {
    Footing footing{x_m, y_m, height_m, turn, kNever};
    const std::optional<LabelImage> view = exact_view_(x_m, y_m, height_m);
    if (!view) return footing;
    for (int t = turn - turns; t <= turn + turns; ++t) {
      const double score = scorer_.score(*view, t);
      if (score > footing.score) footing = {x_m, y_m, height_m, t, score};
    }
    return footing;
  }

  /// To the best neighbour, if one is better.
  bool step(double step_m) {
    const Footing from = best_;
    const auto visit = [&](double dx_m, double dy_m, double dz_m) {
      const Footing there =
          try_at(from.x_m + dx_m, from.y_m + dy_m, from.eye_height_m + dz_m, from.turn, kTurns);
      if (there.score > best_.score) best_ = there;
    };
    for (int ix = -1; ix <= 1; ++ix) {
      for (int iy = -1; iy <= 1; ++iy) {
        if (ix != 0 || iy != 0) visit(ix * step_m, iy * step_m, 0.0);
      }
    }
    for (const double dz_m : {-2.0 * step_m, 2.0 * step_m}) {
      const double off_m = std::abs(from.eye_height_m + dz_m - first_height_m_);
      if (config_.finds_eye_height && off_m <= config_.height_reach_m) visit(0.0, 0.0, dz_m);
    }
    return best_.score > from.score;
  }

  EyePlacement placement(double column_rad) const {
    double part = 0.0;
    if (const auto view = exact_view_(best_.x_m, best_.y_m, best_.eye_height_m)) {
      const double before = scorer_.score(*view, best_.turn - 1);
      const double after = scorer_.score(*view, best_.turn + 1);
      const double bend = before - 2.0 * best_.score + after;
      if (bend < 0.0) part = std::clamp(0.5 * (before - after) / bend, -0.5, 0.5);
    }
    return {{best_.x_m, best_.y_m, wrap_angle((best_.turn + part) * column_rad)},
            best_.eye_height_m,
            best_.score};
  }

  const ColumnScorer& scorer_;
  const ExactView& exact_view_;
  const RefinementConfig& config_;
  double first_height_m_ = 0.0;
  Footing best_;
};

}  // namespace

EyePlacement refine(const EyePlacement& start,
                    const ColumnScorer& scorer,
                    const ExactView& exact_view,
                    const RefinementConfig& config) {
  return Climb(scorer, exact_view, config).run(start);
}

}  // namespace semview::places
