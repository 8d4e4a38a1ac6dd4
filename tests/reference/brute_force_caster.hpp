// SPDX-License-Identifier: Apache-2.0
/// Ray against every triangle, in doubles: slow, plain, and independent of Embree.
#pragma once

#include <limits>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "semview/map/triangle_mesh.hpp"

namespace semview::reference {

struct BruteForceHit {
  ClassId label = kNoHit;
  double parameter = std::numeric_limits<double>::infinity();
};

/// The parameter at which `eye + t · direction` meets a triangle from either side, or +∞.
/// @source Möller and Trumbore 1997, "Fast, minimum storage ray-triangle intersection".
inline double ray_triangle(const Eigen::Vector3d& eye,
                           const Eigen::Vector3d& direction,
                           const Eigen::Vector3d& a,
                           const Eigen::Vector3d& b,
                           const Eigen::Vector3d& c) {
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d edge_ab = b - a;
  const Eigen::Vector3d edge_ac = c - a;
  const Eigen::Vector3d p = direction.cross(edge_ac);
  const double determinant = edge_ab.dot(p);
  if (determinant == 0.0) return kMiss;
  const Eigen::Vector3d s = eye - a;
  const double u = s.dot(p) / determinant;
  if (u < 0.0 || u > 1.0) return kMiss;
  const Eigen::Vector3d q = s.cross(edge_ab);
  const double v = direction.dot(q) / determinant;
  if (v < 0.0 || u + v > 1.0) return kMiss;
  const double t = edge_ac.dot(q) / determinant;
  return t >= 0.0 ? t : kMiss;
}

inline BruteForceHit brute_force_cast(const map::TriangleMesh& mesh,
                                      const Eigen::Vector3d& eye,
                                      const Eigen::Vector3d& direction) {
  BruteForceHit nearest;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto corner = [&](std::size_t k) -> Eigen::Vector3d {
      return mesh.vertices[mesh.triangles[i][k]].cast<double>();
    };
    const double t = ray_triangle(eye, direction, corner(0), corner(1), corner(2));
    if (t < nearest.parameter) nearest = {mesh.labels[i], t};
  }
  return nearest;
}

}  // namespace semview::reference
