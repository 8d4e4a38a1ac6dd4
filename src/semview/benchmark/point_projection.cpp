// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/point_projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace semview::benchmark {

PointCloud point_cloud(const map::ColumnMap& plan) {
  PointCloud points;
  const auto add = [&points](const Eigen::Vector2d& xy, double z_m, ClassId label) {
    points.x_m.push_back(static_cast<float>(xy.x()));
    points.y_m.push_back(static_cast<float>(xy.y()));
    points.z_m.push_back(static_cast<float>(z_m));
    points.labels.push_back(label);
  };
  for (int r = 0; r < plan.rows(); ++r) {
    for (int c = 0; c < plan.columns(); ++c) {
      const ColumnProfile& profile = plan.profile(r, c);
      if (profile.outside) continue;
      const Eigen::Vector2d xy = plan.pixel_center({r, c});
      add(xy, plan.ground_height_m, profile.ground);
      for (const Slab& slab : profile.slabs) {
        const double height_m = slab.z_max_m - slab.z_min_m;
        const int voxels = std::max(1, static_cast<int>(std::lround(height_m / plan.resolution_m)));
        for (int i = 0; i < voxels; ++i) {
          add(xy, slab.z_min_m + height_m * (i + 0.5) / voxels, slab.label);
        }
      }
      if (plan.ceiling) add(xy, plan.ceiling->height_m, plan.ceiling->label);
    }
  }
  return points;
}

LabelImage project_points(const PointCloud& points, const Eye& eye, const PanoramaCamera& camera) {
  LabelImage labels(camera.rows, camera.columns, kNoHit);
  Image<float> nearest(camera.rows, camera.columns, std::numeric_limits<float>::infinity());
  const auto columns_per_rad = static_cast<float>(camera.columns / kTwoPi);
  const auto rows_per_rad =
      static_cast<float>(camera.rows / (camera.elevation_max_rad - camera.elevation_min_rad));
  const auto top_rad = static_cast<float>(camera.elevation_max_rad);
  const auto pi = static_cast<float>(kPi);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float dx = points.x_m[i] - eye.x_m;
    const float dy = points.y_m[i] - eye.y_m;
    const float dz = points.z_m[i] - eye.z_m;
    const float level_squared = dx * dx + dy * dy;
    const float down = (top_rad - std::atan2(dz, std::sqrt(level_squared))) * rows_per_rad;
    if (!(down >= 0.0F) || down >= static_cast<float>(camera.rows)) continue;
    const int row = static_cast<int>(down);
    const int column = std::clamp(
        static_cast<int>((pi - std::atan2(dy, dx)) * columns_per_rad), 0, camera.columns - 1);
    const float squared = level_squared + dz * dz;
    if (squared >= nearest.at(row, column)) continue;
    nearest.at(row, column) = squared;
    labels.at(row, column) = points.labels[i];
  }
  return labels;
}

}  // namespace semview::benchmark
