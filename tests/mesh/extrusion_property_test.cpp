// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
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

// A plan whose slabs reach through the ground and the ceiling, which cut them.
ColumnMap cut_map(Rng& rng) {
  ColumnMap map = random_map(rng);
  map.ground_height_m = -0.75;
  if (map.ceiling) map.ceiling->height_m = 1.0;
  return map;
}

TEST(ExtrusionPropertyTest, EachFaceHasFreeSpaceBeforeItAndItsOwnClassBehindIt) {
  constexpr double kAside_m = 0.01;  // far less than the quarters of which all is made
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Rng rng(seed, "sides");
    const ColumnMap map = seed % 2 == 0 ? random_map(rng) : cut_map(rng);
    const TriangleMesh mesh = extrude(map);
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
      const Eigen::Vector3d a = mesh.vertices[mesh.triangles[k][0]].cast<double>();
      const Eigen::Vector3d ab = mesh.vertices[mesh.triangles[k][1]].cast<double>() - a;
      const Eigen::Vector3d ac = mesh.vertices[mesh.triangles[k][2]].cast<double>() - a;
      const Eigen::Vector3d aside = kAside_m * ab.cross(ac).normalized();
      for (int sample = 0; sample < 8; ++sample) {
        double u = rng.uniform(0.0, 1.0);
        double v = rng.uniform(0.0, 1.0);
        if (u + v > 1.0) {
          u = 1.0 - u;
          v = 1.0 - v;
        }
        const Eigen::Vector3d point = a + u * ab + v * ac;
        const Eigen::Vector3d before = point + aside;
        const Eigen::Vector3d behind = point - aside;
        ASSERT_EQ(solid_at(map, map.at(before.x(), before.y()), before.z()), std::nullopt)
            << "seed " << seed << " triangle " << k;
        ASSERT_EQ(solid_at(map, map.at(behind.x(), behind.y()), behind.z()), mesh.labels[k])
            << "seed " << seed << " triangle " << k;
        const bool within = point.z() > map.ground_height_m - 1e-6 &&
                            (!map.ceiling || point.z() < map.ceiling->height_m + 1e-6);
        ASSERT_TRUE(within) << "seed " << seed << " triangle " << k;
      }
    }
  }
}

/// Class, plane's axis, whether it looks along that axis.
using FaceKind = std::tuple<ClassId, int, bool>;

/// The area between solid and free, found by asking each quarter cube for its six neighbours.
std::map<FaceKind, double> area_of_cubes(const ColumnMap& map) {
  constexpr double kEdge_m = 0.25;  // of pixels and of layers
  std::map<FaceKind, double> areas;
  const auto at = [&](int row, int column, int layer) -> std::optional<ClassId> {
    const auto& image = map.profile_of_pixel;
    const bool inside = row >= 0 && row < image.rows() && column >= 0 && column < image.columns();
    return solid_at(map, inside ? &map.profile(row, column) : nullptr, (layer + 0.5) * kEdge_m);
  };
  const auto low = static_cast<int>(std::lround(map.ground_height_m / kEdge_m));
  const auto high =
      static_cast<int>(std::lround((map.ceiling ? map.ceiling->height_m : 2.0) / kEdge_m));
  for (int row = -1; row <= map.rows(); ++row) {
    for (int column = -1; column <= map.columns(); ++column) {
      for (int layer = low; layer < high; ++layer) {  // free cubes are between ground and ceiling
        if (at(row, column, layer)) continue;
        const std::array<std::array<int, 3>, 3> along{{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}};
        for (int axis = 0; axis < 3; ++axis) {
          const auto& step = along[static_cast<std::size_t>(axis)];
          for (const int sign : {1, -1}) {
            const auto solid =
                at(row + sign * step[0], column + sign * step[1], layer + sign * step[2]);
            if (solid) areas[{*solid, axis, sign < 0}] += kEdge_m * kEdge_m;
          }
        }
      }
    }
  }
  return areas;
}

TEST(ExtrusionPropertyTest, FacesHaveTheAreaBetweenSolidAndFreeCubes) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Rng rng(seed, "area");
    const ColumnMap map = seed % 2 == 0 ? random_map(rng) : cut_map(rng);
    const TriangleMesh mesh = extrude(map);
    std::map<FaceKind, double> areas;
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
      const Eigen::Vector3d a = mesh.vertices[mesh.triangles[k][0]].cast<double>();
      const Eigen::Vector3d ab = mesh.vertices[mesh.triangles[k][1]].cast<double>() - a;
      const Eigen::Vector3d ac = mesh.vertices[mesh.triangles[k][2]].cast<double>() - a;
      const Eigen::Vector3d twice = ab.cross(ac);
      int axis = 0;
      twice.cwiseAbs().maxCoeff(&axis);
      areas[{mesh.labels[k], axis, twice[axis] > 0.0}] += 0.5 * twice.norm();
    }
    // Sums of sixteenths are exact: equal to the last bit.
    ASSERT_EQ(areas, area_of_cubes(map)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace semview::map
