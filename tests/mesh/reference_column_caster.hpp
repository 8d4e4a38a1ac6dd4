// SPDX-License-Identifier: Apache-2.0
/// What a ray meets in a column map and in a mesh, each the slow and obvious way: the first walks
/// from pixel border to pixel border through the solids themselves and knows no triangles, the
/// second tries every triangle.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "semview/map/column_map.hpp"
#include "semview/map/triangle_mesh.hpp"

namespace semview::map {

struct Hit {
  double range_m = std::numeric_limits<double>::infinity();
  ClassId label = kNoHit;
};

/// What stands at a point: the class of the slab, ground or ceiling that it is in, or nothing.
inline std::optional<ClassId> solid_at(const ColumnMap& map,
                                       const ColumnProfile* column,
                                       double z) {
  if (column == nullptr || column->outside) return std::nullopt;
  if (z < map.ground_height_m) return column->ground;
  if (map.ceiling && z > map.ceiling->height_m) return map.ceiling->label;
  for (const Slab& slab : column->slabs) {
    if (z > slab.z_min_m && z < slab.z_max_m) return slab.label;
  }
  return std::nullopt;
}

/// The first solid that a ray from a point in free space enters.
///
/// Nothing, if the ray was before that outside the building and below its ground or above its
/// ceiling: those are sheets without sides, and what is seen of them from behind is not defined.
inline std::optional<Hit> cast_columns(const ColumnMap& map,
                                       const Eigen::Vector3d& from,
                                       const Eigen::Vector3d& dir) {
  const Eigen::Vector2d start = map.plan_from_map(from.x(), from.y());
  const Eigen::Vector2d ahead = map.plan_from_map(from.x() + dir.x(), from.y() + dir.y());
  const Eigen::Vector2d step = ahead - start;
  // Every parameter at which the ray may change column or layer; between two it is in one solid.
  std::vector<double> events{0.0};
  const auto add = [&](double origin, double slope, double plane) {
    if (std::abs(slope) < 1e-12) return;
    const double t = (plane - origin) / slope;
    if (t > 0.0) events.push_back(t);
  };
  for (int i = 0; i <= map.columns(); ++i) add(start.x(), step.x(), i * map.resolution_m);
  for (int j = 0; j <= map.rows(); ++j) add(start.y(), step.y(), j * map.resolution_m);
  add(from.z(), dir.z(), map.ground_height_m);
  if (map.ceiling) add(from.z(), dir.z(), map.ceiling->height_m);
  for (const ColumnProfile& profile : map.profiles) {
    for (const Slab& slab : profile.slabs) {
      add(from.z(), dir.z(), slab.z_min_m);
      add(from.z(), dir.z(), slab.z_max_m);
    }
  }
  std::sort(events.begin(), events.end());
  events.push_back(events.back() + 1.0);
  for (std::size_t k = 0; k + 1 < events.size(); ++k) {
    if (events[k + 1] - events[k] < 1e-12) continue;
    const Eigen::Vector3d middle = from + 0.5 * (events[k] + events[k + 1]) * dir;
    const ColumnProfile* column = map.at(middle.x(), middle.y());
    if (const auto label = solid_at(map, column, middle.z())) return Hit{events[k], *label};
    const bool outside = column == nullptr || column->outside;
    const bool behind =
        middle.z() < map.ground_height_m || (map.ceiling && middle.z() > map.ceiling->height_m);
    if (outside && behind) return std::nullopt;
  }
  return Hit{};
}

/// Möller and Trumbore's test against every triangle; the side does not matter.
inline Hit cast_triangles(const TriangleMesh& mesh,
                          const Eigen::Vector3d& from,
                          const Eigen::Vector3d& dir) {
  Hit nearest;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const Eigen::Vector3d a = mesh.vertices[mesh.triangles[k][0]].cast<double>();
    const Eigen::Vector3d ab = mesh.vertices[mesh.triangles[k][1]].cast<double>() - a;
    const Eigen::Vector3d ac = mesh.vertices[mesh.triangles[k][2]].cast<double>() - a;
    const Eigen::Vector3d p = dir.cross(ac);
    const double det = ab.dot(p);
    if (std::abs(det) < 1e-14) continue;
    const Eigen::Vector3d offset = from - a;
    const double u = offset.dot(p) / det;
    const Eigen::Vector3d q = offset.cross(ab);
    const double v = dir.dot(q) / det;
    const double t = ac.dot(q) / det;
    if (u < -1e-9 || v < -1e-9 || u + v > 1.0 + 1e-9 || t <= 1e-9) continue;
    if (t < nearest.range_m) nearest = {t, mesh.labels[k]};
  }
  return nearest;
}

}  // namespace semview::map
