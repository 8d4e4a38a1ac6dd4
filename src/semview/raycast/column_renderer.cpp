// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/column_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace semview::raycast {
namespace {

/// The rows of one column of pixels, filled from near to far.
class PixelColumn {
 public:
  explicit PixelColumn(const std::vector<double>& tangents) : tangents_(tangents) {}

  void clear() { gaps_.assign(1, {0, static_cast<int>(tangents_.size())}); }
  bool full() const { return gaps_.empty(); }

  /// Calls `fill(first_row, end_row)` for the rows between two tangents that are still free, and
  /// takes them.
  template <typename Fill>
  void take(double low, double high, Fill&& fill) {
    if (!(low <= high) || gaps_.empty()) return;
    // Rows look down from the highest tangent.
    const auto first = std::partition_point(
        tangents_.begin(), tangents_.end(), [high](double tangent) { return tangent > high; });
    const auto last = std::partition_point(
        first, tangents_.end(), [low](double tangent) { return tangent >= low; });
    const int begin = static_cast<int>(first - tangents_.begin());
    const int end = static_cast<int>(last - tangents_.begin());
    if (begin == end) return;
    next_.clear();
    for (const Gap& gap : gaps_) {
      const int from = std::max(begin, gap.begin);
      const int to = std::min(end, gap.end);
      if (from >= to) {
        next_.push_back(gap);
        continue;
      }
      fill(from, to);
      if (gap.begin < from) next_.push_back({gap.begin, from});
      if (to < gap.end) next_.push_back({to, gap.end});
    }
    gaps_.swap(next_);
  }

 private:
  struct Gap {
    int begin;
    int end;
  };
  const std::vector<double>& tangents_;
  std::vector<Gap> gaps_;
  std::vector<Gap> next_;
};

/// Tangent of elevation to a height, `rise` above the eye, at a distance; a height of the eye's own
/// at distance 0 is straight ahead.
double tangent_to(double rise_m, double distance_m) {
  if (rise_m == 0.0) return 0.0;
  return rise_m / distance_m;
}

RunPlane upright(double distance_m) {
  const double nearest_m = kMinPlaneDistance_m;
  return {static_cast<float>(1.0 / std::max(distance_m, nearest_m)), 0.0F};
}

RunPlane level(double rise_m) {
  const double nearest_m = kMinPlaneDistance_m;
  const double distance_m = std::copysign(std::max(std::abs(rise_m), nearest_m), rise_m);
  return {0.0F, static_cast<float>(1.0 / distance_m)};
}

/// Paints what stands over one stretch, from its slabs outwards, by `paint(low, high, label,
/// plane)` with tangents of elevation.
template <typename Paint>
void paint_stretch(const map::ColumnMap& plan,
                   const Stretch& stretch,
                   double eye_z_m,
                   Paint&& paint) {
  const ColumnProfile& profile = plan.profiles[stretch.profile];
  if (profile.outside) return;
  const double near = stretch.begin;
  const double far = stretch.end;
  const auto sheet = [&](double height_m, ClassId label) {
    const double rise = height_m - eye_z_m;
    const double a = tangent_to(rise, near);
    const double b = tangent_to(rise, far);
    paint(std::min(a, b), std::max(a, b), label, level(rise));
  };
  const bool eye_below_ground = eye_z_m < plan.ground_height_m;
  const bool eye_above_ceiling = plan.ceiling && eye_z_m > plan.ceiling->height_m;
  if (eye_below_ground) sheet(plan.ground_height_m, profile.ground);
  if (eye_above_ceiling) sheet(plan.ceiling->height_m, plan.ceiling->label);
  const auto body = [&](const Slab& slab) {
    const double bottom = slab.z_min_m - eye_z_m;
    const double top = slab.z_max_m - eye_z_m;
    paint(tangent_to(bottom, near), tangent_to(top, near), slab.label, upright(near));
    if (top < 0.0) paint(tangent_to(top, near), tangent_to(top, far), slab.label, level(top));
    if (bottom > 0.0) {
      paint(tangent_to(bottom, far), tangent_to(bottom, near), slab.label, level(bottom));
    }
  };
  // What is nearer to the height of the eye hides what is behind it of the same stretch.
  const auto above = std::ranges::find_if(
      profile.slabs, [eye_z_m](const Slab& slab) { return slab.z_max_m > eye_z_m; });
  for (auto slab = above; slab != profile.slabs.end(); ++slab) body(*slab);
  for (auto slab = above; slab != profile.slabs.begin();) body(*--slab);
  if (!eye_below_ground) sheet(plan.ground_height_m, profile.ground);
  if (plan.ceiling && !eye_above_ceiling) sheet(plan.ceiling->height_m, plan.ceiling->label);
}

std::vector<double> tangents_of(const PanoramaCamera& camera) {
  std::vector<double> tangents;
  for (int r = 0; r < camera.rows; ++r) tangents.push_back(std::tan(camera.elevation_rad(r)));
  return tangents;
}

struct Piece {
  int begin;
  int end;
  ClassId label;
  RunPlane plane;
};

/// Runs from the pieces of column after column.
class RunCollector {
 public:
  RunCollector(const PanoramaCamera& camera, bool ranges) : rows_(camera.rows), ranges_(ranges) {}

  void add_column(std::vector<Piece>& pieces) {
    std::ranges::sort(pieces, {}, &Piece::begin);
    const std::size_t start = runs_.size();
    int row = 0;
    for (const Piece& piece : pieces) {
      if (piece.begin > row) add(start, piece.begin, kNoHit, {});
      add(start, piece.end, piece.label, piece.plane);
      row = piece.end;
    }
    if (row < rows_) add(start, rows_, kNoHit, {});
    first_run_.push_back(static_cast<std::uint32_t>(runs_.size()));
  }

  ColumnView view() {
    return *ColumnView::from_runs(
        rows_, std::move(first_run_), std::move(runs_), std::move(planes_));
  }

 private:
  void add(std::size_t start, int end, ClassId label, const RunPlane& plane) {
    const bool same = runs_.size() > start && runs_.back().label == label &&
                      (!ranges_ || planes_.back() == plane);
    if (same) {
      runs_.back().end_row = static_cast<std::uint16_t>(end);
      return;
    }
    runs_.push_back({static_cast<std::uint16_t>(end), label});
    if (ranges_) planes_.push_back(plane);
  }

  int rows_;
  bool ranges_;
  std::vector<std::uint32_t> first_run_{0};
  std::vector<Run> runs_;
  std::vector<RunPlane> planes_;
};

}  // namespace

ColumnView render_column_view(const ColumnScene& scene,
                              const PanoramaRequest& request,
                              bool ranges) {
  const PanoramaCamera& camera = request.camera;
  const Eigen::Vector2d eye(request.map_from_robot.x_m, request.map_from_robot.y_m);
  const std::vector<double> tangents = tangents_of(camera);
  PixelColumn pixels(tangents);
  RunCollector collector(camera, ranges);
  std::vector<Piece> pieces;
  for (int c = 0; c < camera.columns; ++c) {
    const double azimuth = request.map_from_robot.yaw_rad + camera.azimuth_rad(c);
    const Eigen::Vector3d ahead = request.affine.apply({std::cos(azimuth), std::sin(azimuth), 0.0});
    ColumnWalk walk(scene, eye, ahead.head<2>());
    pixels.clear();
    pieces.clear();
    const auto paint = [&](double low, double high, ClassId label, const RunPlane& plane) {
      pixels.take(low, high, [&](int begin, int end) {
        pieces.push_back({begin, end, label, plane});
      });
    };
    for (Stretch stretch; !pixels.full() && walk.next(stretch);) {
      paint_stretch(scene.plan(), stretch, request.eye_z_m, paint);
    }
    collector.add_column(pieces);
  }
  return collector.view();
}

Panorama render_panorama(const ColumnScene& scene, const PanoramaRequest& request) {
  const ColumnView view = render_column_view(scene, request, true);
  return {view.to_labels(), view.to_ranges(request.camera)};
}

}  // namespace semview::raycast
