// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/panorama_renderer.hpp"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "semview/geometry/pose_grid.hpp"
#include "semview/raycast/plane_runs.hpp"
#include "semview/raycast/ray_caster.hpp"
#include "semview/view/view_profile.hpp"

namespace semview::raycast {
namespace {

tl::unexpected<Error> wrong(std::string field, std::string message) {
  return fail(Error{ErrorCode::kInvalidArgument, std::move(message), std::move(field)});
}

/// The rays of a panorama: a product of what a column and what a row contributes.
class PanoramaRays {
 public:
  explicit PanoramaRays(const PanoramaRequest& request) {
    const PanoramaCamera& camera = request.camera;
    for (int c = 0; c < camera.columns; ++c) {
      const double azimuth = request.map_from_robot.yaw_rad + camera.azimuth_rad(c);
      columns_.push_back(request.affine.apply({std::cos(azimuth), std::sin(azimuth), 0.0}));
    }
    for (int r = 0; r < camera.rows; ++r) {
      const double elevation = camera.elevation_rad(r);
      rows_.emplace_back(std::cos(elevation), std::sin(elevation));
    }
  }

  RayDirection operator()(int row, int column) const {
    const Eigen::Vector3d& level = columns_[static_cast<std::size_t>(column)];
    const Eigen::Vector2d& tilt = rows_[static_cast<std::size_t>(row)];
    return {static_cast<float>(tilt.x() * level.x()),
            static_cast<float>(tilt.x() * level.y()),
            static_cast<float>(tilt.y())};
  }

 private:
  std::vector<Eigen::Vector3d> columns_;  // level, drawn metres per true metre
  std::vector<Eigen::Vector2d> rows_;     // cosine and sine of the elevation
};

RayCaster caster_at(const Scene& scene, const PanoramaRequest& request) {
  return {scene,
          static_cast<float>(request.map_from_robot.x_m),
          static_cast<float>(request.map_from_robot.y_m),
          static_cast<float>(request.eye_z_m)};
}

Panorama blank(const PanoramaCamera& camera) {
  return {LabelImage(camera.rows, camera.columns), RangeImage(camera.rows, camera.columns)};
}

}  // namespace

Status validate(const MapAffine& affine) {
  const auto scales = [](double factor) { return factor >= 0.2 && factor <= 5.0; };
  if (!scales(affine.a) || !scales(affine.b)) {
    return wrong(
        "affine",
        fmt::format("affine scales a {:g} and b {:g} must be within 0.2 to 5", affine.a, affine.b));
  }
  if (!(affine.k >= -2.0 && affine.k <= 2.0)) {
    return wrong("affine", fmt::format("affine shear k {:g} must be within -2 to 2", affine.k));
  }
  return {};
}

Status validate(const PanoramaRequest& request) {
  const auto inside = [](double coordinate) {
    return std::abs(coordinate) <= PoseGrid::kMaxCoordinate_m;
  };
  const Pose2& pose = request.map_from_robot;
  if (!inside(pose.x_m) || !inside(pose.y_m) || !std::isfinite(pose.yaw_rad)) {
    return wrong("pose",
                 fmt::format("pose ({:g}, {:g}, {:g}) must be finite and within {:g} m",
                             pose.x_m,
                             pose.y_m,
                             pose.yaw_rad,
                             PoseGrid::kMaxCoordinate_m));
  }
  if (!inside(request.eye_z_m)) {
    return wrong("eye_height_m",
                 fmt::format("eye height {:g} m must be finite and within {:g} m",
                             request.eye_z_m,
                             PoseGrid::kMaxCoordinate_m));
  }
  const PanoramaCamera& camera = request.camera;
  if (camera.columns < 1 || camera.columns > kMaxPanoramaColumns) {
    return wrong("columns",
                 fmt::format("columns {} must be 1 to {}", camera.columns, kMaxPanoramaColumns));
  }
  if (camera.rows < 1 || camera.rows > kMaxPanoramaRows) {
    return wrong("rows", fmt::format("rows {} must be 1 to {}", camera.rows, kMaxPanoramaRows));
  }
  if (!(camera.elevation_min_rad >= -kPi / 2.0 && camera.elevation_max_rad <= kPi / 2.0 &&
        camera.elevation_min_rad < camera.elevation_max_rad)) {
    return wrong("elevation",
                 fmt::format("elevation {:g} to {:g} degrees must increase within -90 to 90",
                             deg_from_rad(camera.elevation_min_rad),
                             deg_from_rad(camera.elevation_max_rad)));
  }
  return validate(request.affine);
}

Panorama render_panorama(const Scene& scene, const PanoramaRequest& request) {
  Panorama panorama = blank(request.camera);
  cast_tiles(caster_at(scene, request),
             request.camera.rows,
             request.camera.columns,
             PanoramaRays(request),
             [&](int row, int column, const RayHit& hit) {
               panorama.labels.at(row, column) = hit.label;
               panorama.ranges_m.at(row, column) = hit.parameter;
             });
  return panorama;
}

ColumnView render_column_view(const Scene& scene, const PanoramaRequest& request, bool ranges) {
  if (ranges) {
    TriangleImage triangles(request.camera.rows, request.camera.columns, kNoTriangle);
    cast_tiles(caster_at(scene, request),
               request.camera.rows,
               request.camera.columns,
               PanoramaRays(request),
               [&](int row, int column, const RayHit& hit) {
                 if (hit.label != kNoHit) triangles.at(row, column) = hit.triangle;
               });
    return runs_with_planes(scene, request, triangles);
  }
  LabelImage labels(request.camera.rows, request.camera.columns);
  cast_tiles(caster_at(scene, request),
             request.camera.rows,
             request.camera.columns,
             PanoramaRays(request),
             [&](int row, int column, const RayHit& hit) { labels.at(row, column) = hit.label; });
  return ColumnView::from_labels(labels);
}

Panorama render_panorama_single_rays(const Scene& scene, const PanoramaRequest& request) {
  Panorama panorama = blank(request.camera);
  cast_singly(caster_at(scene, request),
              request.camera.rows,
              request.camera.columns,
              PanoramaRays(request),
              [&](int row, int column, const RayHit& hit) {
                panorama.labels.at(row, column) = hit.label;
                panorama.ranges_m.at(row, column) = hit.parameter;
              });
  return panorama;
}

}  // namespace semview::raycast
