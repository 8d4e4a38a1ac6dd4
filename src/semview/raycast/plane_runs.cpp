// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/plane_runs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "semview/raycast/scene_impl.hpp"

namespace semview::raycast {
namespace {

/// A panorama column's rays: along cos ε · level + sin ε · up, with `level` in drawn metres.
struct Level {
  double x, y;
};

/// The planes of triangles, as the eye sees them.
class PlaneSeer {
 public:
  PlaneSeer(const Scene::Impl& scene, const PanoramaRequest& request)
      : scene_(scene),
        eye_(request.map_from_robot.x_m, request.map_from_robot.y_m, request.eye_z_m) {}

  /// The triangle's plane for the rays of a column, facing the one at (cosine, sine): with the
  /// plane n · p = n · eye + h a ray meets it at range t, 1/t = n · direction / h.
  RunPlane plane(std::uint32_t triangle, const Level& level, double cosine, double sine) const {
    const Eigen::Vector3d corner = scene_.corner(triangle, 0);
    const Eigen::Vector3d normal =
        (scene_.corner(triangle, 1) - corner).cross(scene_.corner(triangle, 2) - corner);
    const double length = normal.norm();
    const double along = normal.x() * level.x + normal.y() * level.y;
    const double sign = along * cosine + normal.z() * sine < 0.0 ? -1.0 : 1.0;
    const double height_m = std::max(sign * normal.dot(corner - eye_) / length,
                                     static_cast<double>(kMinPlaneDistance_m));
    const double scale = sign / (length * height_m);
    return {static_cast<float>(along * scale), static_cast<float>(normal.z() * scale)};
  }

 private:
  const Scene::Impl& scene_;
  Eigen::Vector3d eye_;
};

/// Cosine and sine of the elevation of each row.
struct Row {
  double cosine, sine;
};

double range_m(const RunPlane& plane, const Row& row) {
  return 1.0 / (plane.a_per_m * row.cosine + plane.b_per_m * row.sine);
}

bool agree(const RunPlane& one, const RunPlane& other, const Row& row) {
  return std::abs(range_m(one, row) - range_m(other, row)) <= kSameSurface_m;
}

std::vector<Row> rows_of(const PanoramaCamera& camera) {
  std::vector<Row> rows;
  for (int r = 0; r < camera.rows; ++r) {
    rows.push_back({std::cos(camera.elevation_rad(r)), std::sin(camera.elevation_rad(r))});
  }
  return rows;
}

}  // namespace

ColumnView runs_with_planes(const Scene& scene,
                            const PanoramaRequest& request,
                            const TriangleImage& triangles) {
  const PanoramaCamera& camera = request.camera;
  const PlaneSeer seer(scene.impl(), request);
  const std::vector<Row> rows = rows_of(camera);
  std::vector<std::uint32_t> first_run{0};
  std::vector<Run> runs;
  std::vector<RunPlane> planes;
  for (int c = 0; c < camera.columns; ++c) {
    const double azimuth = request.map_from_robot.yaw_rad + camera.azimuth_rad(c);
    const Eigen::Vector3d ahead = request.affine.apply({std::cos(azimuth), std::sin(azimuth), 0.0});
    for (int top = 0, end = 0; top < camera.rows; top = end) {
      const std::uint32_t triangle = triangles.at(top, c);
      while (end < camera.rows && triangles.at(end, c) == triangle) ++end;
      const Row& first = rows[static_cast<std::size_t>(top)];
      const Row& last = rows[static_cast<std::size_t>(end) - 1];
      ClassId label = kNoHit;
      RunPlane plane;
      if (triangle != kNoTriangle) {
        label = scene.impl().labels[triangle];
        plane = seer.plane(triangle, {ahead.x(), ahead.y()}, first.cosine, first.sine);
      }
      // Planes that agree at both ends of a stretch agree all along it.
      const bool goes_on = top > 0 && label == runs.back().label &&
                           agree(plane, planes.back(), first) && agree(plane, planes.back(), last);
      if (!goes_on) {
        runs.push_back({0, label});
        planes.push_back(plane);
      }
      runs.back().end_row = static_cast<std::uint16_t>(end);
    }
    first_run.push_back(static_cast<std::uint32_t>(runs.size()));
  }
  return *ColumnView::from_runs(
      camera.rows, std::move(first_run), std::move(runs), std::move(planes));
}

}  // namespace semview::raycast
