// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/panorama_renderer.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "semview/geometry/pose_grid.hpp"
#include "semview/raycast/image_caster.hpp"
#include "semview/raycast/plane_runs.hpp"
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
      const Eigen::Vector3d level =
          request.affine.apply({std::cos(azimuth), std::sin(azimuth), 0.0});
      level_x_.push_back(level.x());
      level_y_.push_back(level.y());
    }
    for (int r = 0; r < camera.rows; ++r) {
      const double elevation = camera.elevation_rad(r);
      cosine_.push_back(std::cos(elevation));
      sine_.push_back(static_cast<float>(std::sin(elevation)));
    }
  }

  RayDirection operator()(int row, int column) const {
    const auto r = static_cast<std::size_t>(row);
    const auto c = static_cast<std::size_t>(column);
    return {static_cast<float>(cosine_[r] * level_x_[c]),
            static_cast<float>(cosine_[r] * level_y_[c]),
            sine_[r]};
  }

  void tile(const TilePlace& place, TileDirections& directions) const {
    std::array<double, kTileColumns> x, y;
    for (std::size_t k = 0; k < kTileColumns; ++k) {
      x[k] = level_x_[static_cast<std::size_t>(place.columns[k])];
      y[k] = level_y_[static_cast<std::size_t>(place.columns[k])];
    }
    for (std::size_t i = 0; i < kTileRows; ++i) {
      const double cosine = cosine_[static_cast<std::size_t>(place.rows[i])];
      const float sine = sine_[static_cast<std::size_t>(place.rows[i])];
      for (std::size_t k = 0; k < kTileColumns; ++k) {
        directions.x[i * kTileColumns + k] = static_cast<float>(cosine * x[k]);
        directions.y[i * kTileColumns + k] = static_cast<float>(cosine * y[k]);
        directions.z[i * kTileColumns + k] = sine;
      }
    }
  }

 private:
  std::vector<double> level_x_, level_y_;  // of a column: drawn metres per true metre
  std::vector<double> cosine_;             // of a row's elevation
  std::vector<float> sine_;
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
