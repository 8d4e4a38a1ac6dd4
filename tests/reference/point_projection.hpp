// SPDX-License-Identifier: Apache-2.0
/// Views by projecting a labelled point cloud, as the 2017 paper makes them.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "semview/geometry/panorama_camera.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/map/column_map.hpp"
#include "semview/view/column_view.hpp"

namespace semview::reference {

struct LabelledPoint {
  Eigen::Vector3d position_map;
  ClassId label = kNoHit;
};

/// The point cloud of a plan: one point a `spacing_m` over every slab's volume, over the ground and
/// over the ceiling.
/// @source Neubert et al. 2017, section III-A: "the 2D semantic map can be converted into a 3D
/// semantic point cloud". Differs: a pixel may hold several slabs.
inline std::vector<LabelledPoint> point_cloud(const map::ColumnMap& plan, double spacing_m) {
  std::vector<LabelledPoint> points;
  const double width_m = plan.columns() * plan.resolution_m;
  const double height_m = plan.rows() * plan.resolution_m;
  for (double v = spacing_m / 2.0; v < height_m; v += spacing_m) {
    for (double u = spacing_m / 2.0; u < width_m; u += spacing_m) {
      const Eigen::Vector2d xy = plan.map_from_plan(u, v);
      const ColumnProfile* profile = plan.at(xy.x(), xy.y());
      if (profile == nullptr || profile->outside) continue;
      points.push_back({{xy.x(), xy.y(), plan.ground_height_m}, profile->ground});
      for (const Slab& slab : profile->slabs) {
        const int layers =
            std::max(1, static_cast<int>(std::lround((slab.z_max_m - slab.z_min_m) / spacing_m)));
        for (int i = 0; i <= layers; ++i) {
          const double z = slab.z_min_m + (slab.z_max_m - slab.z_min_m) * i / layers;
          points.push_back({{xy.x(), xy.y(), z}, slab.label});
        }
      }
      if (plan.ceiling) {
        points.push_back({{xy.x(), xy.y(), plan.ceiling->height_m}, plan.ceiling->label});
      }
    }
  }
  return points;
}

/// Projects every point onto the unit sphere around the eye and keeps, for each pixel, the class of
/// the nearest point that falls into it; a pixel without points is `kNoHit`.
/// @source Neubert et al. 2017, section III-A.
inline LabelImage project_points(const std::vector<LabelledPoint>& points,
                                 const Pose2& map_from_robot,
                                 double eye_z_m,
                                 const PanoramaCamera& camera) {
  LabelImage labels(camera.rows, camera.columns, kNoHit);
  Image<double> nearest_m(camera.rows, camera.columns, std::numeric_limits<double>::infinity());
  for (const LabelledPoint& point : points) {
    const double dx = point.position_map.x() - map_from_robot.x_m;
    const double dy = point.position_map.y() - map_from_robot.y_m;
    const double dz = point.position_map.z() - eye_z_m;
    const double distance_m = std::hypot(dx, dy, dz);
    const int row = camera.row_of(std::atan2(dz, std::hypot(dx, dy)));
    if (row < 0) continue;
    const int column = camera.column_of(std::atan2(dy, dx) - map_from_robot.yaw_rad);
    if (distance_m >= nearest_m.at(row, column)) continue;
    nearest_m.at(row, column) = distance_m;
    labels.at(row, column) = point.label;
  }
  return labels;
}

}  // namespace semview::reference
