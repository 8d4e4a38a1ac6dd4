// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/column_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace semview::raycast {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The rows of one column of pixels, filled from near to far.
class PixelColumn {
 public:
  explicit PixelColumn(const std::vector<double>& tangents) : tangents_(tangents) {}

  void clear() {
    gaps_.assign(1, {0, static_cast<int>(tangents_.size())});
  }
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

/// Paints what stands over one stretch, from its slabs outwards. `paint(low, high, label, distance)`
/// gets `distance(tangent)`, the horizontal distance at which a ray hits.
template <typename Paint>
void paint_stretch(const map::ColumnMap& plan,
                   const Stretch& stretch,
                   double eye_z_m,
                   Paint&& paint) {
  const ColumnProfile& profile = plan.profiles[stretch.profile];
  if (profile.outside) return;
  const double near = stretch.begin;
  const double far = stretch.end;
  const auto body = [&](const Slab& slab) {
    const double bottom = slab.z_min_m - eye_z_m;
    const double top = slab.z_max_m - eye_z_m;
    // Below the eye a body is seen up to the far edge of its top, above it down to that of its
    // underside.
    const double low = tangent_to(bottom, bottom > 0.0 ? far : near);
    const double high = tangent_to(top, top < 0.0 ? far : near);
    paint(low, high, slab.label, [=](double tangent) {
      const double rise = tangent * near;
      if (rise > top) return top / tangent;
      if (rise < bottom) return bottom / tangent;
      return near;
    });
  };
  // What is nearer to the height of the eye hides what is behind it of the same stretch.
  const auto above = std::ranges::find_if(
      profile.slabs, [eye_z_m](const Slab& slab) { return slab.z_max_m > eye_z_m; });
  for (auto slab = above; slab != profile.slabs.end(); ++slab) body(*slab);
  for (auto slab = above; slab != profile.slabs.begin();) body(*--slab);
  const auto sheet = [&](double height_m, ClassId label) {
    const double rise = height_m - eye_z_m;
    const double a = tangent_to(rise, near);
    const double b = tangent_to(rise, far);
    paint(std::min(a, b), std::max(a, b), label, [rise](double tangent) { return rise / tangent; });
  };
  sheet(plan.ground_height_m, profile.ground);
  if (plan.ceiling) sheet(plan.ceiling->height_m, plan.ceiling->label);
}

/// Renders column by column: `begin(column)`, then `fill(first_row, end_row, label, distance)` for
/// what is seen, then `end(column)`.
template <typename Begin, typename Fill, typename End>
void render(const ColumnScene& scene,
            const PanoramaRequest& request,
            const std::vector<double>& tangents,
            Begin&& begin,
            Fill&& fill,
            End&& end) {
  const PanoramaCamera& camera = request.camera;
  const Eigen::Vector2d eye(request.map_from_robot.x_m, request.map_from_robot.y_m);
  PixelColumn pixels(tangents);
  for (int c = 0; c < camera.columns; ++c) {
    const double azimuth = request.map_from_robot.yaw_rad + camera.azimuth_rad(c);
    const Eigen::Vector3d ahead =
        request.affine.apply({std::cos(azimuth), std::sin(azimuth), 0.0});
    ColumnWalk walk(scene, eye, ahead.head<2>());
    pixels.clear();
    begin(c);
    for (Stretch stretch; !pixels.full() && walk.next(stretch);) {
      paint_stretch(scene.plan(),
                    stretch,
                    request.eye_z_m,
                    [&](double low, double high, ClassId label, auto&& distance) {
                      pixels.take(low, high, [&](int first, int last) {
                        fill(c, first, last, label, distance);
                      });
                    });
    }
    end(c);
  }
}

std::vector<double> tangents_of(const PanoramaCamera& camera) {
  std::vector<double> tangents;
  for (int r = 0; r < camera.rows; ++r) tangents.push_back(std::tan(camera.elevation_rad(r)));
  return tangents;
}

}  // namespace

ColumnView render_column_view(const ColumnScene& scene, const PanoramaRequest& request) {
  const int rows = request.camera.rows;
  struct Piece {
    int begin;
    int end;
    ClassId label;
  };
  std::vector<Piece> pieces;
  std::vector<Run> runs;
  std::vector<std::uint32_t> first_run{0};
  runs.reserve(static_cast<std::size_t>(request.camera.columns) * 4);
  first_run.reserve(static_cast<std::size_t>(request.camera.columns) + 1);
  render(
      scene,
      request,
      tangents_of(request.camera),
      [&](int) { pieces.clear(); },
      [&](int, int first, int last, ClassId label, auto&&) {
        pieces.push_back({first, last, label});
      },
      [&](int) {
        std::ranges::sort(pieces, {}, &Piece::begin);
        const std::size_t start = runs.size();
        const auto add = [&](int end, ClassId label) {
          if (runs.size() > start && runs.back().label == label) {
            runs.back().end_row = static_cast<std::uint16_t>(end);
          } else {
            runs.push_back({static_cast<std::uint16_t>(end), label});
          }
        };
        int row = 0;
        for (const Piece& piece : pieces) {
          if (piece.begin > row) add(piece.begin, kNoHit);
          add(piece.end, piece.label);
          row = piece.end;
        }
        if (row < rows) add(rows, kNoHit);
        first_run.push_back(static_cast<std::uint32_t>(runs.size()));
      });
  return *ColumnView::from_runs(rows, std::move(first_run), std::move(runs));
}

Panorama render_panorama(const ColumnScene& scene, const PanoramaRequest& request) {
  const PanoramaCamera& camera = request.camera;
  const std::vector<double> tangents = tangents_of(camera);
  Panorama panorama{LabelImage(camera.rows, camera.columns, kNoHit),
                    RangeImage(camera.rows, camera.columns, static_cast<float>(kInfinity))};
  render(
      scene,
      request,
      tangents,
      [](int) {},
      [&](int c, int first, int last, ClassId label, auto&& distance) {
        for (int r = first; r < last; ++r) {
          const double tangent = tangents[static_cast<std::size_t>(r)];
          panorama.labels.at(r, c) = label;
          panorama.ranges_m.at(r, c) =
              static_cast<float>(distance(tangent) * std::sqrt(1.0 + tangent * tangent));
        }
      },
      [](int) {});
  return panorama;
}

}  // namespace semview::raycast
