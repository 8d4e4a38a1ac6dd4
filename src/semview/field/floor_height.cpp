// SPDX-License-Identifier: Apache-2.0
#include "semview/field/floor_height.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>

namespace semview::field {
namespace {

/// Triangles within 20° of level, facing up.
constexpr float kLevel = 0.94F;
/// The floor has at least this share of the area of the largest level: a table does not, but what
/// noise leaves below the floor has less.
constexpr double kShareOfLargest = 0.25;

struct Level {
  double area_m2 = 0.0;
  double moment_m3 = 0.0;  ///< area × height
};

}  // namespace

double floor_height_m(const map::TriangleMesh& mesh, ClassId floor, double level_m) {
  std::map<int, Level> levels;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    if (floor != kNoHit && mesh.labels[k] != floor) continue;
    const auto& [a, b, c] = mesh.triangles[k];
    const Eigen::Vector3f& first = mesh.vertices[a];
    const Eigen::Vector3f& second = mesh.vertices[b];
    const Eigen::Vector3f& third = mesh.vertices[c];
    const Eigen::Vector3f normal = (second - first).cross(third - first);
    const float twice_m2 = normal.norm();
    if (!(normal.z() > kLevel * twice_m2)) continue;
    const double area_m2 = 0.5 * static_cast<double>(twice_m2);
    const double height_m = static_cast<double>(first.z() + second.z() + third.z()) / 3.0;
    Level& level = levels[static_cast<int>(std::floor(height_m / level_m))];
    level.area_m2 += area_m2;
    level.moment_m3 += area_m2 * height_m;
  }
  double largest_m2 = 0.0;
  for (const auto& [index, level] : levels) largest_m2 = std::max(largest_m2, level.area_m2);
  for (const auto& [index, level] : levels) {
    if (level.area_m2 >= kShareOfLargest * largest_m2) return level.moment_m3 / level.area_m2;
  }
  double lowest_m = 0.0;
  if (!mesh.vertices.empty()) {
    lowest_m = static_cast<double>(
        std::ranges::min_element(mesh.vertices, {}, [](const auto& v) { return v.z(); })->z());
  }
  return lowest_m;
}

}  // namespace semview::field
