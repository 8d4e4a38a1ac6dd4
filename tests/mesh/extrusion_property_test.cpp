// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "mesh/reference_column_caster.hpp"
#include "semview/core/random.hpp"
#include "semview/map/extrusion.hpp"

namespace semview::map {
namespace {

// Sizes and heights in quarters: exact as floats, so that touching is exact too.
ColumnProfile random_profile(Rng& rng) {
  ColumnProfile profile;
  profile.ground = static_cast<ClassId>(1 + rng.below(3));
  double z_m = -1.0;
  while (profile.slabs.size() < rng.below(4)) {
    z_m += rng.below(3) == 0 ? 0.0 : 0.25 * static_cast<double>(1 + rng.below(4));
    const double top_m = z_m + 0.25 * static_cast<double>(1 + rng.below(5));
    if (z_m >= 1.5) break;
    profile.slabs.push_back({z_m, std::min(top_m, 1.5), static_cast<ClassId>(4 + rng.below(4))});
    z_m = top_m;
  }
  return profile;
}

ColumnMap random_map(Rng& rng) {
  ColumnMap map;
  map.resolution_m = 0.25;
  map.ground_height_m = -1.0;
  if (rng.below(4) != 0) map.ceiling = Ceiling{9, 1.5};
  map.profiles.push_back({.outside = true, .slabs = {}});
  for (int p = 0; p < 5; ++p) map.profiles.push_back(random_profile(rng));
  map.profile_of_pixel =
      Image<std::uint8_t>(static_cast<int>(1 + rng.below(7)), static_cast<int>(1 + rng.below(7)));
  for (auto& pixel : map.profile_of_pixel.pixels()) {
    pixel = static_cast<std::uint8_t>(rng.below(map.profiles.size()));
  }
  return map;
}

TEST(ExtrusionPropertyTest, RaysMeetTheMeshWhereTheyEnterASolidOfThePlan) {
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    Rng rng(seed, "extrusion");
    ColumnMap map = random_map(rng);
    const bool turned = seed % 3 == 2;
    if (turned)
      map.origin = {rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0), rng.uniform(-3.0, 3.0)};
    const TriangleMesh mesh = extrude(map);
    for (int ray = 0; ray < 60; ++ray) {
      const Eigen::Vector2d plan(rng.uniform(0.0, map.columns() * 0.25),
                                 rng.uniform(0.0, map.rows() * 0.25));
      const Eigen::Vector2d place = map.map_from_plan(plan.x(), plan.y());
      const Eigen::Vector3d from(place.x(), place.y(), rng.uniform(-1.0, 1.5));
      const ColumnProfile* column = map.at(from.x(), from.y());
      if (column->outside || solid_at(map, column, from.z())) continue;
      const Eigen::Vector3d direction =
          Eigen::Vector3d(rng.normal(0.0, 1.0), rng.normal(0.0, 1.0), rng.normal(0.0, 0.5))
              .normalized();
      const auto expected = cast_columns(map, from, direction);
      if (!expected) continue;
      const Hit hit = cast_triangles(mesh, from, direction);
      ++compared;
      ASSERT_EQ(hit.label, expected->label) << "seed " << seed << " ray " << ray;
      if (expected->label != kNoHit) {
        ASSERT_NEAR(hit.range_m, expected->range_m, turned ? 1e-4 : 1e-6) << "seed " << seed;
      }
    }
  }
  EXPECT_GT(compared, 7000);
}

using Polygon = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double signed_area(const Polygon& polygon) {
  double doubled = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    doubled += cross(polygon[k], polygon[(k + 1) % polygon.size()]);
  }
  return 0.5 * doubled;
}

// Sutherland and Hodgman: `polygon` cut to the counter-clockwise triangle `by`.
double overlap_area(Polygon polygon, const Polygon& by) {
  for (std::size_t k = 0; k < 3 && !polygon.empty(); ++k) {
    const Eigen::Vector2d base = by[k];
    const Eigen::Vector2d edge = by[(k + 1) % 3] - base;
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector2d p = polygon[i];
      const Eigen::Vector2d q = polygon[(i + 1) % polygon.size()];
      const double side_p = cross(edge, p - base);
      const double side_q = cross(edge, q - base);
      if (side_p >= 0.0) kept.push_back(p);
      if ((side_p > 0.0 && side_q < 0.0) || (side_p < 0.0 && side_q > 0.0)) {
        kept.push_back(p + (q - p) * (side_p / (side_p - side_q)));
      }
    }
    polygon = std::move(kept);
  }
  return polygon.size() < 3 ? 0.0 : std::abs(signed_area(polygon));
}

TEST(ExtrusionPropertyTest, NoTwoTrianglesOfOnePlaneOverlap) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Rng rng(seed, "overlap");
    const TriangleMesh mesh = extrude(random_map(rng));
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<std::pair<float, Polygon>> flat;  // the triangles across this axis
      for (const auto& corners : mesh.triangles) {
        const float plane = mesh.vertices[corners[0]][axis];
        Polygon polygon;
        for (const std::uint32_t v : corners) {
          if (mesh.vertices[v][axis] != plane) break;
          polygon.emplace_back(mesh.vertices[v][(axis + 1) % 3], mesh.vertices[v][(axis + 2) % 3]);
        }
        if (polygon.size() < 3) continue;
        ASSERT_NE(signed_area(polygon), 0.0) << "degenerate, seed " << seed;
        if (signed_area(polygon) < 0.0) std::reverse(polygon.begin(), polygon.end());
        flat.emplace_back(plane, std::move(polygon));
      }
      for (std::size_t i = 0; i < flat.size(); ++i) {
        for (std::size_t j = i + 1; j < flat.size(); ++j) {
          if (flat[i].first != flat[j].first) continue;
          ASSERT_LT(overlap_area(flat[i].second, flat[j].second), 1e-9) << "seed " << seed;
        }
      }
    }
  }
}

}  // namespace
}  // namespace semview::map
